"""Whether Ctrl-C was pressed while a client followed its goal."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript


def require_interrupted(run: Transcript) -> float:
    """Require that Ctrl-C was pressed while the goal was under way, and return when (s)."""
    signalled = run.first(ev.NodeSignalled)
    if signalled is None:
        raise unseen(run, "Ctrl-C was not pressed, because the goal never was under way")
    return signalled.t

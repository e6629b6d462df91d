"""Have the page of JupyterLab save its notebook, by a script that only uses what a user could click."""

from __future__ import annotations

import os
import time
from pathlib import Path

from ros_runtime.notebook_domains import NOTEBOOK, is_notebook_of_a_lab

SAVE_TIMEOUT = 3.0  # s for JupyterLab to save the notebook
SAVE_POLL = 0.1  # s
# What the button with the disk does, which then takes the focus; once more when the cell has ended, for its outputs.
_SAVE = """{
const panel = document.querySelector('.jp-NotebookPanel:not(.lm-mod-hidden)');
const save = () => {
    const focused = document.activeElement;
    panel?.querySelector('[data-command="docmanager:save"]')?.click();
    setTimeout(() => focused.focus({preventScroll: true}));
};
save();
const waiting = setInterval(() => {
    const ended = panel?.querySelector('.jp-Notebook-ExecutionIndicator[data-status="idle"]');
    if (panel?.isConnected && !(ended && panel.checkVisibility())) return;
    clearInterval(waiting);
    save();
}, 500);
}"""


def save_notebook() -> None:
    """Have JupyterLab save the notebook that is shown, while its cell runs on, and again when the cell has ended.

    In a notebook of `course lab` it returns as soon as the notebook is saved, at the latest after SAVE_TIMEOUT.
    """
    notebook = Path(os.environ.get(NOTEBOOK, ""))
    before = notebook.stat().st_mtime if is_notebook_of_a_lab() and notebook.is_file() else None
    _run(_SAVE)
    deadline = time.monotonic() + SAVE_TIMEOUT
    while before and notebook.stat().st_mtime == before and time.monotonic() < deadline:
        time.sleep(SAVE_POLL)


def _run(script: str) -> None:
    """Run a script in the page; other editors ignore it."""
    from IPython.display import Javascript, display  # not needed in a terminal

    shown = display(Javascript(script), display_id=True)
    if shown is not None:
        # the script must not stay in the notebook, because it would run again when the notebook is opened
        shown.update({"text/plain": ""}, raw=True)

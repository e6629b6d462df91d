"""How far an arena was behind its clock, which happens on a busy machine."""

from __future__ import annotations

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript

STRAINED = 0.15  # s the simulator may be late in a retry
OVERLOADED = 0.5  # s the simulator may be late before a run is not judged at all
SPARE = 0.5  # of the time a node has to appear; a sound one needs a fifth of it, so what is lost here delays nothing


def lateness(transcript: Transcript) -> float:
    """Return how far (s, arena's clock) the simulator was behind at worst, once the node was ready.

    Without a robot it is the longest delay of the arena's own wake-ups or, if that is more, what the program lost in
    the worst second because it got no processor. The sum over a run says nothing: two seconds that are lost little by
    little, in thirty, delay nothing that a check looks at. A node that never came was only waited for.
    """
    if absent := transcript.first(ev.NodeNotReady):
        lost = [robot.lag for robot in transcript.ground_truth]
        lost += [starved.altogether for starved in transcript.all(ev.Starved)]
        return max(0.0, max(lost, default=0.0) - absent.waited * SPARE)
    ready = transcript.first(ev.NodeReady)
    since = ready.t + 1.0 if ready else 0.0
    lags = [robot.lag for robot in transcript.ground_truth if robot.t >= since]
    if not transcript.ground_truth:
        lags = [woken.late for woken in transcript.all(ev.WokenLate)]
        lags += [starved.seconds for starved in transcript.all(ev.Starved)]
    return max(lags, default=0.0)

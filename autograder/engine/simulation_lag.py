"""How far an arena fell behind its clock; this happens on a busy machine."""

from __future__ import annotations

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript

RETRY_LAG = 0.15  # s of lag tolerated in a retry
MAX_LAG = 0.5  # s of lag tolerated in any run that is judged
SPARE = 0.5  # share of the wait for a missing node that may be lost; a correct node appears in a fifth of the wait


def lateness(transcript: Transcript) -> float:
    """Return the worst lag (s, arena's clock) of the simulator, once the node was ready.

    Without a robot, it is the longest delay of the agent's wake-ups or, if larger, the processor time that the program
    missed in its worst second. Sums over a run are not used: 2 s lost in small parts over 30 s delay no event that is
    checked. If the node never appeared, it is the time lost in excess of SPARE times the waiting time.
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

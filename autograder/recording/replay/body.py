"""Shows the robot in a recorded posture."""

from __future__ import annotations

from bisect import bisect_right

import mujoco
import numpy as np

from autograder.recording.replay.recording import Posture, Recording, UnusableRecording
from robot_sim.body import MissingParts
from robot_sim.humanoid import Humanoid
from robot_sim.model.scenes import SCENES


class RecordedBody:
    """A humanoid that can be set to the postures of a recording.

    Raises:
        UnusableRecording: the recording was made with another robot or scene, or packages of its robot are missing.
    """

    def __init__(self, recording: Recording) -> None:
        scene = recording.about["scene"]
        if scene not in SCENES:
            raise UnusableRecording(
                f"{recording.path} has the unknown scene {scene[:40]!r}; the known scenes are {', '.join(SCENES)}"
            )
        try:
            self.humanoid = Humanoid(scene, robot=recording.about.get("robot") or "humanoid")
        except (ValueError, MissingParts) as error:
            raise UnusableRecording(f"{recording.path}: {error}") from None
        model = self.humanoid.model
        known = {model.joint(index).name for index in range(model.njnt)}
        if other := sorted({*recording.joints, *recording.postures[0].objects} - known):
            raise UnusableRecording(
                f"{recording.path} was made with another robot: the present robot has no joint {other[0][:40]!r}; show "
                "the recording with the version of the course that made it"
            )
        self._places = np.array([model.joint(name).qposadr[0] for name in recording.joints], dtype=int)
        self._postures = recording.postures
        self._times = [posture.t for posture in recording.postures]

    def show(self, t: float) -> None:
        """Set the robot to the posture at a time (s), interpolated between two recorded postures."""
        after = bisect_right(self._times, t)
        later = self._postures[min(after, len(self._postures) - 1)]
        earlier = self._postures[max(after - 1, 0)]
        gap = later.t - earlier.t
        self._take(earlier, later, min(max((t - earlier.t) / gap, 0.0), 1.0) if gap > 0 else 0.0)

    def _take(self, earlier: Posture, later: Posture, share: float) -> None:
        data = self.humanoid.data
        data.qpos[:7] = _between(earlier.base, later.base, share)
        data.qpos[self._places] = (1 - share) * np.array(earlier.joints) + share * np.array(later.joints)
        for name, place in earlier.objects.items():
            data.joint(name).qpos[:] = _between(place, later.objects.get(name, place), share)
        mujoco.mj_forward(self.humanoid.model, data)  # mj_forward also normalizes the quaternions


def _between(earlier: object, later: object, share: float) -> np.ndarray:
    """Interpolate between two poses; the result has MuJoCo's order, w first in the quaternion."""
    first, second = np.array(earlier, dtype=float), np.array(later, dtype=float)
    if np.dot(first[3:], second[3:]) < 0:  # q and -q are the same rotation; choose the nearer one
        second[3:] *= -1
    pose = (1 - share) * first + share * second
    return pose[[0, 1, 2, 6, 3, 4, 5]]

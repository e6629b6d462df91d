"""The ground truth of a graded robot, written to a pipe that student code cannot reach and so cannot forge."""

from __future__ import annotations

import json
import math
import os
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass

from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side

GROUND_TRUTH_RATE = 50.0  # Hz, simulated


@dataclass(frozen=True)
class BatterySample:
    """One published battery_state: percentage 0..1, voltage V, current A (negative: discharging)."""

    percentage: float
    voltage: float
    current: float


class GroundTruthWriter:
    """A writer of JSON objects, one on each line; `t` is `time.monotonic()` of the writing process, s."""

    def __init__(self, fd: int) -> None:
        self._fd = fd

    def ready(self) -> None:
        """Write that the robot stands and its topics exist."""
        self._write({"kind": "ready"})

    def robot(
        self, humanoid: Humanoid, lag: float, command: tuple[float, float, float] | None = None
    ) -> None:
        """Write the robot's state and how far (s) the simulation was behind the clock, at most, since the last time."""
        pose, velocity = humanoid.base_pose(), humanoid.base_velocity()
        x, y, z = pose.position.tolist()
        vx, vy, _ = velocity.linear.tolist()
        self._write(
            {
                "kind": "robot",
                "simulated": humanoid.time,
                "lag": lag,
                "x": x,
                "y": y,
                "z": z,
                "yaw": float(pose.yaw),
                "speed": math.hypot(vx, vy),
                "turn_rate": float(velocity.angular[2]),
                "up": float(humanoid.up()),
                "mode": int(humanoid.mode),
                "motors_enabled": bool(humanoid.motors_enabled),
                "steps": int(humanoid.steps),
                "battery": float(humanoid.battery.percentage),
            }
        )

    def battery_published(self, sample: BatterySample) -> None:
        """Write what went out on battery_state."""
        self._write({"kind": "battery", **asdict(sample)})

    def joints_published(self, names: Sequence[str], positions: Sequence[float]) -> None:
        """Write what goes out on joint_states: a position for each name, rad (fingers: m)."""
        self._write({"kind": "joints", "names": list(names), "positions": list(positions)})

    def arm(self, humanoid: Humanoid, side: Side) -> None:
        """Write where elbow and hand of an arm are: m from its shoulder, along the torso's x, y and z."""
        data = humanoid.data
        shoulder = data.body(f"{side.letter}_shoulder_pitch_link").xpos
        axes = data.body("torso").xmat.reshape(3, 3)
        elbow = (data.body(f"{side.letter}_forearm").xpos - shoulder) @ axes
        hand = (data.site(f"{side.letter}_grip").xpos - shoulder) @ axes
        self._write({"kind": "arm", "side": side.letter, "elbow": elbow.tolist(), "hand": hand.tolist()})

    def peers(self, subscribers: dict[str, int], publishers: dict[str, int]) -> None:
        """Write how many subscribers and publishers of other nodes the robot is connected to, by topic."""
        self._write({"kind": "peers", "subscribers": subscribers, "publishers": publishers})

    def refused(self, topic: str, count: int, largest: int, reason: str) -> None:
        """Write how many messages of a topic were refused so far, the largest one's bytes, and why."""
        self._write({"kind": "refused", "topic": topic, "count": count, "bytes": largest, "reason": reason})

    def commanded(self, command: dict) -> None:
        """Write a command of the scenario when it takes effect."""
        self._write({"kind": "command", "command": command})

    def _write(self, record: dict) -> None:
        line = json.dumps({"t": time.monotonic(), **record}) + "\n"
        view = memoryview(line.encode())
        while view:
            view = view[os.write(self._fd, view) :]

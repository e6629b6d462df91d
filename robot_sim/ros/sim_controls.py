"""Controls that a real robot does not have: pause, step, reset, push, hold, charge. Absent while grading."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Vector3
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from humanoid_interfaces.srv import SetFloat64
from robot_sim.humanoid import Humanoid
from robot_sim.ros.inbox import Inbox
from robot_sim.ros.pacing import Pacing

FASTEST = 100.0  # times real time
LONGEST_STEP = 60.0  # s


class SimControls:
    """The controls under /sim, on the node of the humanoid.

    Attributes:
        paused: the simulation stands still.
        inboxes: of the topics it subscribes to.
    """

    def __init__(self, node: Node, humanoid: Humanoid, pacing: Pacing) -> None:
        self._node, self._humanoid, self._pacing = node, humanoid, pacing
        self.paused = False
        self._steps_left = 0
        self._reset_wanted = False
        self._held_joint = ""
        services: list[tuple[Any, str, Any]] = [
            (SetBool, "set_pause", self._set_pause),
            (SetFloat64, "step_simulation", self._step_simulation),
            (Trigger, "reset_world", self._reset_world),
            (SetFloat64, "set_battery", self._set_battery),
            (SetFloat64, "set_real_time_factor", self._set_real_time_factor),
        ]
        for service_type, name, answer in services:
            node.create_service(service_type, f"/sim/{name}", answer)
        self.inboxes = [
            Inbox(node.create_subscription(Vector3, "/sim/push", self._push, 10)),
            Inbox(node.create_subscription(String, "/sim/hold_joint", self._hold_joint, 10)),
        ]

    def steps_due(self, most: int) -> int:
        """Return how many steps to make now: `most`; while paused, as many of them as were requested."""
        if not self.paused:
            return most
        steps = min(most, self._steps_left)
        self._steps_left -= steps
        return steps

    def take_reset(self) -> bool:
        """Return whether a reset was requested since the last call."""
        wanted, self._reset_wanted = self._reset_wanted, False
        return wanted

    def _set_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self.paused, self._steps_left = request.data, 0
        self._pacing.restart(self._humanoid.time)
        response.success, response.message = True, "paused" if request.data else "running"
        return response

    def _step_simulation(
        self, request: SetFloat64.Request, response: SetFloat64.Response
    ) -> SetFloat64.Response:
        duration = request.data
        if not self.paused:
            response.message = "the simulation runs; pause it first (/sim/set_pause)"
        elif not 0 < duration <= LONGEST_STEP:
            response.message = (
                f"{duration} s cannot be stepped; expected more than 0, at most {LONGEST_STEP:g} s"
            )
        else:
            self._steps_left = max(1, round(duration / self._humanoid.timestep))
            self._pacing.restart(self._humanoid.time)
            response.success = True
            response.message = f"{self._steps_left} steps of {self._humanoid.timestep * 1000:g} ms"
        return response

    def _reset_world(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._reset_wanted = True
        response.success, response.message = True, "the robot stands at the origin, time is 0"
        return response

    def _set_battery(self, request: SetFloat64.Request, response: SetFloat64.Response) -> SetFloat64.Response:
        try:
            self._humanoid.battery.set_percentage(request.data)
        except ValueError as error:
            response.message = str(error)
        else:
            response.success, response.message = True, f"{request.data:.0%}"
        return response

    def _set_real_time_factor(
        self, request: SetFloat64.Request, response: SetFloat64.Response
    ) -> SetFloat64.Response:
        if not (math.isfinite(request.data) and 0 <= request.data <= FASTEST):
            response.message = (
                f"{request.data} is not possible; expected 0 (as fast as it can) to {FASTEST:g}"
            )
            return response
        self._pacing.real_time_factor = request.data
        self._pacing.restart(self._humanoid.time)
        response.success, response.message = True, f"{request.data:g} times real time"
        return response

    def _push(self, impulse: Vector3) -> None:
        """Push the torso with an impulse in N·s, odom frame, over 0.1 s."""
        try:
            self._humanoid.push((impulse.x, impulse.y, impulse.z))
        except ValueError as error:
            self._node.get_logger().error(f"/sim/push ignored: {error}")

    def _hold_joint(self, joint: String) -> None:
        """Hold a joint in place and release the one held before; an empty name only releases."""
        self._humanoid.release_joint(self._held_joint)
        self._held_joint = ""
        if not joint.data:
            return
        try:
            self._humanoid.hold_joint(joint.data)
        except ValueError as error:
            self._node.get_logger().error(f"/sim/hold_joint ignored: {error}")
        else:
            self._held_joint = joint.data

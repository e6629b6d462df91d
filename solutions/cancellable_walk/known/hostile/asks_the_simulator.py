"""Attack: looks for the simulator's own services to put the robot at the goal or to stop its time, instead of
walking.
Outcome: while grading there are none, so it never gets there.
Caught by: arrives, rejects_a_wrong_frame, rejects_nan, rejects_without_power
Also fails: feedback_keeps_its_rate, cancels_in_mid_stride, stops_when_canceled, aborts_when_the_robot_falls
"""

import rclpy
from humanoid_interfaces.action import WalkTo
from rclpy.action import ActionServer, CancelResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Empty, SetBool, Trigger

CONTROLS = {"set_pause": SetBool, "reset_world": Trigger, "reset_simulation": Empty, "step_simulation": Trigger}


class Cheat(Node):
    def __init__(self):
        super().__init__("walk_server")
        self.controls = [
            self.create_client(kind, f"{prefix}{name}")
            for name, kind in CONTROLS.items()
            for prefix in ("/sim/", "sim/", "/robot/sim/", "humanoid/")
        ]
        self.server = ActionServer(
            self, WalkTo, "walk_to", self.execute, cancel_callback=lambda goal_handle: CancelResponse.ACCEPT
        )

    def execute(self, goal_handle):
        result = WalkTo.Result(final_pose=goal_handle.request.target_pose)
        found = [control for control in self.controls if control.service_is_ready()]
        for control in found:
            control.call(control.srv_type.Request(), timeout_sec=1.0)
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
        elif found:
            goal_handle.succeed()
        else:
            goal_handle.abort()
        return result


def main(args=None):
    rclpy.init(args=args)
    node = Cheat()
    try:
        rclpy.spin(node, MultiThreadedExecutor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""Attack: raises nothing, and publishes odom and loads in the robot's name that say it has risen, then succeeds.
Outcome: height and loads come from the simulator by a pipe of its own; forged topics are nobody's truth.
Caught by: rises, gives_up_in_time, cancels_under_way, aborts_when_the_robot_falls
Also fails: percent_never_falls, knows_that_a_fall_is_the_end
"""

import time

import rclpy
from geometry_msgs.msg import WrenchStamped
from humanoid_interfaces.action import StandUp
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class Forger(Node):
    def __init__(self):
        super().__init__("humanoid")
        self.height = None
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.odom = self.create_publisher(Odometry, "odom", 10)
        self.feet = [self.create_publisher(WrenchStamped, f"{side}_foot/wrench", 10) for side in "lr"]
        self.server = ActionServer(
            self,
            StandUp,
            "stand_up",
            execute_callback=self.execute,
            goal_callback=lambda request: GoalResponse.REJECT if self.height is None else GoalResponse.ACCEPT,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )

    def on_odom(self, message):
        self.height = message.pose.pose.position.z

    def forge(self, height):
        odom = Odometry(child_frame_id="base_link")
        odom.header.frame_id, odom.header.stamp = "odom", self.get_clock().now().to_msg()
        odom.pose.pose.position.z = height
        self.odom.publish(odom)
        for foot in self.feet:
            wrench = WrenchStamped()
            wrench.header.stamp = odom.header.stamp
            wrench.wrench.force.z = 186.0
            foot.publish(wrench)

    def execute(self, handle):
        result = StandUp.Result()
        if self.height >= 0.59:
            result.error_code, result.error_msg = StandUp.Result.ALREADY_STANDING, "it stands already"
            handle.abort()
            return result
        for tenth in range(24):
            if handle.is_cancel_requested:
                handle.canceled()
                return result
            share = max(0.0, min(1.0, (tenth - 4) / 12))
            self.forge(0.45 + 0.15 * share)
            phase = "shifting" if tenth < 4 else "rising" if share < 0.95 else "settling"
            if tenth % 2 == 0:
                handle.publish_feedback(StandUp.Feedback(phase=phase, percent_complete=99.0 * share))
            time.sleep(0.1)
        handle.publish_feedback(StandUp.Feedback(phase="settling", percent_complete=100.0))
        handle.succeed()
        return result


def main(args=None):
    rclpy.init(args=args)
    executor = MultiThreadedExecutor(num_threads=3)
    node = Forger()
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()

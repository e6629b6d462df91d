"""Attack: answers with two thousand joints named in colours and control characters, to burst the transcript or
the instructor's screen.
Outcome: it is a wrong answer like any other; what a verdict quotes of it is cut short and printable.
Caught by: keeps_the_order_asked, positions_are_the_robots, names_every_unknown_joint, says_when_it_knows_nothing
Also fails: no_names_means_all
"""

import rclpy
from humanoid_interfaces.srv import GetJointPositions
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


class Boaster(Node):
    def __init__(self):
        super().__init__("joint_query")
        self.create_service(GetJointPositions, "get_joint_positions", self.on_request)

    def on_request(self, request, response):
        response.success = True
        response.message = "\x1b[2J\x1b[31m</pre><script>alert(1)</script>" * 100
        response.joint_state.name = ["\x1b[32m l_elbow"] * 2000
        response.joint_state.position = [float("nan")] * 2000
        return response


def main(args=None):
    rclpy.init(args=args)
    node = Boaster()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""Attack: leaves the motors alone and publishes a robot_state of its own in which they obey; answers with that.
Outcome: motors are judged by what the simulator reports through its own pipe, not by the topic.
Caught by: powers_off, follows_the_robot, says_when_it_knows_nothing
"""

import rclpy
from humanoid_interfaces.msg import RobotState
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger


class Forger(Node):
    def __init__(self):
        super().__init__("humanoid")  # the robot's own name
        self.state = RobotState(mode=RobotState.STANDING, motors_enabled=True)
        self.topic = self.create_publisher(RobotState, "robot_state", 10)
        self.create_timer(0.01, lambda: self.topic.publish(self.state))
        self.create_service(SetBool, "enable_motors", self.on_enable)
        self.create_service(Trigger, "get_status", self.on_status)

    def on_enable(self, request, response):
        self.state.motors_enabled = request.data
        self.state.mode = RobotState.STANDING if request.data else RobotState.OFF
        response.success = True
        return response

    def on_status(self, request, response):
        response.success = True
        response.message = "Motors: ON" if self.state.motors_enabled else "Motors: OFF"
        return response


def main(args=None):
    rclpy.init(args=args)
    node = Forger()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""Fault: sleeps until robot_state confirms, on the only thread that could take it (M2)
Caught by: powers_off
"""

import time

import rclpy
from humanoid_interfaces.msg import RobotState
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger


class MotorServices(Node):
    def __init__(self):
        super().__init__("motor_services")
        self.state = None
        self.power = self.create_publisher(Bool, "motor_power", 10)
        self.create_subscription(RobotState, "robot_state", self.on_robot_state, 10)
        self.create_service(SetBool, "enable_motors", self.on_enable)
        self.create_service(Trigger, "get_status", self.on_status)

    def on_robot_state(self, message):
        self.state = message

    def on_enable(self, request, response):
        if not request.data and self.state is not None and self.state.mode == RobotState.WALKING:
            response.success = False
            response.message = "the robot is walking: stop it first"
            return response
        self.power.publish(Bool(data=request.data))
        while self.state is None or self.state.motors_enabled != request.data:
            time.sleep(0.05)
        response.success = True
        response.message = "power on" if request.data else "power off"
        return response

    def on_status(self, request, response):
        if self.state is None:
            response.success = False
            response.message = "no robot_state has arrived yet"
        else:
            response.success = True
            response.message = "Motors: ON" if self.state.motors_enabled else "Motors: OFF"
        return response


def main(args=None):
    rclpy.init(args=args)
    node = MotorServices()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()

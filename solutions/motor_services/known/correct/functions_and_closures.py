"""Style: functions and closures over a dictionary, no class; refuses power off as long as it cannot judge; spin_once in a loop."""

import sys

import rclpy
from humanoid_interfaces.msg import RobotState
from rclpy.executors import ExternalShutdownException
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

STATUS = {True: "Motors: ON", False: "Motors: OFF"}


def why_not(on, state):
    """Return why power may not be switched, or an empty string."""
    if on:
        return ""
    if state is None:
        return "the robot has not been heard of"
    return "it would fall: it is walking" if state.mode == RobotState.WALKING else ""


def add_services(node):
    robot = {}
    power = node.create_publisher(Bool, "motor_power", 1)

    def enable(request, response):
        response.message = why_not(request.data, robot.get("state"))
        response.success = not response.message
        if response.success:
            power.publish(Bool(data=request.data))
        return response

    def status(_request, response):
        if state := robot.get("state"):
            return Trigger.Response(success=True, message=STATUS[state.motors_enabled])
        response.message = "unknown"
        return response

    node.create_subscription(
        RobotState, "robot_state", lambda state: robot.update(state=state), qos_profile_sensor_data
    )
    node.create_service(SetBool, "enable_motors", enable)
    node.create_service(Trigger, "get_status", status)


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("motors")
    add_services(node)
    try:
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.5)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Style: MultiThreadedExecutor and a condition; answers when robot_state confirms that the motors have obeyed."""

import threading
from contextlib import suppress

import rclpy
from humanoid_interfaces.msg import RobotState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
CONFIRMATION_TIMEOUT = 4.0  # s


class MotorServices(Node):
    def __init__(self):
        super().__init__("motor_services")
        self._heard = threading.Condition()
        self._state = None
        self._power = self.create_publisher(Bool, "motor_power", 10)
        self.create_subscription(
            RobotState, "robot_state", self._hear, LATCHED, callback_group=MutuallyExclusiveCallbackGroup()
        )
        services = ReentrantCallbackGroup()
        self.create_service(SetBool, "enable_motors", self._enable, callback_group=services)
        self.create_service(Trigger, "get_status", self._status, callback_group=services)

    def _hear(self, state):
        with self._heard:
            self._state = state
            self._heard.notify_all()

    def _enable(self, request, response):
        with self._heard:
            if self._is_walking() and not request.data:
                response.message = "refused: the robot is walking"
                return response
            self._power.publish(Bool(data=request.data))
            response.success = self._heard.wait_for(
                lambda: self._state is not None and self._state.motors_enabled == request.data,
                CONFIRMATION_TIMEOUT,
            )
        response.message = "confirmed" if response.success else "the robot did not confirm it"
        return response

    def _status(self, request, response):
        with self._heard:
            state = self._state
        response.success = state is not None
        if state is None:
            response.message = "not known yet"
        else:
            response.message = f"Motors: {'ON' if state.motors_enabled else 'OFF'}"
        return response

    def _is_walking(self):
        return self._state is not None and self._state.mode == RobotState.WALKING


def main(args=None):
    rclpy.init(args=args)
    node = MotorServices()
    executor = MultiThreadedExecutor(num_threads=6)
    executor.add_node(node)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""Style: one thread and async callbacks; enable_motors awaits a future that a fitting robot_state completes, or a timer."""

import time
from contextlib import contextmanager

import rclpy
from humanoid_interfaces.msg import RobotState
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

PATIENCE = 2.5  # s


class MotorServices(Node):
    def __init__(self):
        super().__init__("motor_services")
        self.state = None
        self.waiting = []
        self.power = self.create_publisher(Bool, "motor_power", 10)
        self.create_subscription(RobotState, "robot_state", self.on_state, 1)
        # In the node's own group its unfinished callback would keep on_state from running.
        self.create_service(SetBool, "enable_motors", self.on_enable, callback_group=ReentrantCallbackGroup())
        self.create_service(Trigger, "get_status", self.on_status)
        self.create_timer(0.2, self.give_up)

    async def on_state(self, state):
        self.state = state
        for wanted, future, _end in self.waiting:
            if state.motors_enabled == wanted:
                future.set_result(True)
        self.waiting = [each for each in self.waiting if not each[1].done()]

    def give_up(self):
        for _wanted, future, end in self.waiting:
            if time.monotonic() > end:
                future.set_result(False)
        self.waiting = [each for each in self.waiting if not each[1].done()]

    async def on_enable(self, request, response):
        if self.state and self.state.mode == RobotState.WALKING and not request.data:
            response.message = "stop walking first"
            return response
        obeyed = Future()
        self.waiting.append((request.data, obeyed, time.monotonic() + PATIENCE))
        self.power.publish(Bool(data=request.data))
        response.success = await obeyed
        response.message = "confirmed" if response.success else "the robot has not confirmed it"
        return response

    async def on_status(self, request, response):
        if self.state is None:
            response.message = "unknown"
            return response
        response.success = True
        response.message = "Motors: ON" if self.state.motors_enabled else "Motors: OFF"
        return response


@contextmanager
def running(node_class, args):
    rclpy.init(args=args)
    node = node_class()
    try:
        yield node
    except (KeyboardInterrupt, ExternalShutdownException):
        node.get_logger().info("good night")
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def main(args=None):
    with running(MotorServices, args) as node:
        rclpy.spin(node)


if __name__ == "__main__":
    main()

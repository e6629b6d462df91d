"""Attack: prints a status for every answer it can think of, and ends with status 0 whatever happens
Outcome: the line has to be the one line, with the message of the answer
Caught by: prints_the_status
Also fails: gives_up_without_servers, asks_once_more, makes_use_of_the_second_answer, copes_with_two_servers
"""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

PER_CALL = 2.0  # s
ATTEMPTS = 2
NO_ANSWER, REFUSED = 1, 1


class NoAnswer(Exception):
    pass


class RobotController(Node):
    def __init__(self):
        super().__init__("robot_controller")
        self._enable = self.create_client(SetBool, "enable_motors")
        self._status = self.create_client(Trigger, "get_status")

    def enable_motors(self):
        return self._call(self._enable, SetBool.Request(data=True))

    def get_status(self):
        return self._call(self._status, Trigger.Request())

    def _call(self, client, request):
        if not client.wait_for_service(timeout_sec=PER_CALL):
            raise NoAnswer(f"nobody offers {client.srv_name}")
        for _ in range(ATTEMPTS):
            future = client.call_async(request)
            rclpy.spin_until_future_complete(self, future, timeout_sec=PER_CALL)
            if future.done():
                return future.result()
            client.remove_pending_request(future)
        raise NoAnswer(f"{client.srv_name} has not answered within {PER_CALL:g} s, twice")


def run(controller):
    for guess in ("Motors: ON", "Motors: OFF"):
        print(f"Robot status: {guess}")
    try:
        enabled = controller.enable_motors()
        if not enabled.success:
            print(f"the motors stay off: {enabled.message}", file=sys.stderr)
            return REFUSED
        print(f"Robot status: {controller.get_status().message}")
        return 0
    except NoAnswer as problem:
        print(problem, file=sys.stderr)
        return NO_ANSWER


def main(args=None):
    rclpy.init(args=args)
    controller = RobotController()
    try:
        return run(controller)
    except (KeyboardInterrupt, ExternalShutdownException):
        return NO_ANSWER
    finally:
        controller.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())

"""Style: a coroutine of the executor; each answer races with a timer, and the whole coroutine with another."""

import sys

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger


class GivesUp(Exception):
    pass


class Controller:
    def __init__(self, node):
        self.node = node

    async def sleep(self, seconds):
        over = Future()
        timer = self.node.create_timer(seconds, lambda: over.done() or over.set_result(None))
        await over
        self.node.destroy_timer(timer)

    async def first_answer(self, client, request, seconds):
        """The answer, or None when the time is over first."""
        answer = client.call_async(request)
        either = Future()
        answer.add_done_callback(lambda _: either.done() or either.set_result(None))
        timer = self.node.create_timer(seconds, lambda: either.done() or either.set_result(None))
        await either
        self.node.destroy_timer(timer)
        if answer.done():
            return answer.result()
        client.remove_pending_request(answer)
        return None

    async def ask(self, service_type, name, request):
        client = self.node.create_client(service_type, name)
        for _ in range(40):
            if client.service_is_ready():
                break
            await self.sleep(0.05)
        else:
            raise GivesUp(f"{name}: no server within 2 s")
        answer = await self.first_answer(client, request, 2.0)
        if answer is None:
            answer = await self.first_answer(client, request, 2.0)
        if answer is None:
            raise GivesUp(f"{name}: no answer, though asked twice")
        return answer

    async def run(self):
        try:
            enabled = await self.ask(SetBool, "enable_motors", SetBool.Request(data=True))
            if not enabled.success:
                raise GivesUp(f"enable_motors: {enabled.message}")
            status = await self.ask(Trigger, "get_status", Trigger.Request())
        except GivesUp as reason:
            print(reason, file=sys.stderr)
            return 1
        print(f"Robot status: {status.message}")
        return 0


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("robot_controller")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        task = executor.create_task(Controller(node).run)
        executor.spin_until_future_complete(task, timeout_sec=10.0)
        if not task.done():
            print("not done within 10 s", file=sys.stderr)
            return 1
        return task.result()
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())

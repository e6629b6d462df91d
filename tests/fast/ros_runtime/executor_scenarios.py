"""Nodes on a MultiThreadedExecutor, to be run in a process of their own: `python executor_scenarios.py NAME`.

Each scenario returns what it saw, which is printed as JSON.
"""

import json
import sys
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

WORKERS = 2


def all_workers_sleep_while_messages_arrive():
    """CPU time per second of spinning, and how many messages were handled once a worker was free again."""
    node, executor, spinner = spinning_node()
    received = []
    node.create_subscription(Empty, "fast", received.append, 100, callback_group=ReentrantCallbackGroup())
    publisher = node.create_publisher(Empty, "fast", 100)
    asleep = threading.Barrier(WORKERS + 1)

    def sleep_once():
        asleep.wait()
        time.sleep(1.0)

    sleepers = [executor.create_task(sleep_once) for _ in range(WORKERS)]
    asleep.wait()
    begin, cpu = time.monotonic(), time.process_time()
    for _ in range(20):
        publisher.publish(Empty())
        time.sleep(0.04)
    load = (time.process_time() - cpu) / (time.monotonic() - begin)
    wait_until(lambda: all(task.done() for task in sleepers) and len(received) == 20)
    stop(executor, spinner)
    return {"load": load, "received": len(received)}


def spin_once_with_a_timeout_returns_though_all_workers_sleep():
    node, executor = Node("node"), MultiThreadedExecutor(WORKERS)
    executor.add_node(node)
    release = threading.Event()
    for _ in range(WORKERS + 1):
        executor.create_task(release.wait)
    begin = time.monotonic()
    for _ in range(WORKERS + 2):
        executor.spin_once(timeout_sec=0.1)
    elapsed = time.monotonic() - begin
    release.set()
    return {"elapsed": elapsed}


def shutdown_ends_the_spin_though_all_workers_sleep():
    _, executor, spinner = spinning_node()
    release, asleep = threading.Event(), threading.Semaphore(0)

    def sleep():
        asleep.release()
        release.wait()

    for _ in range(WORKERS + 1):
        executor.create_task(sleep)
    for _ in range(WORKERS):
        asleep.acquire()
    begin = time.monotonic()
    executor.shutdown(timeout_sec=0)
    spinner.join(10.0)
    ended = not spinner.is_alive()
    release.set()
    return {"ended": ended, "elapsed": time.monotonic() - begin}


def a_callback_that_raises_ends_the_spin():
    node, executor = Node("node"), MultiThreadedExecutor(WORKERS)
    executor.add_node(node)

    def fail():
        raise ValueError("a student's mistake")

    node.create_timer(0.01, fail)
    try:
        executor.spin()
    except ValueError as error:
        return {"raised": str(error)}
    return {"raised": None}


def an_async_callback_awaits_a_service_of_the_same_node():
    node, executor, spinner = spinning_node()
    group = MutuallyExclusiveCallbackGroup()

    def answer(request, response):
        time.sleep(0.05)
        response.message = "answered"
        return response

    node.create_service(Trigger, "service", answer)
    client = node.create_client(Trigger, "service", callback_group=group)
    answers = []

    async def ask(_):
        answers.append((await client.call_async(Trigger.Request())).message)

    node.create_subscription(Empty, "ask", ask, 10, callback_group=ReentrantCallbackGroup())
    publisher = node.create_publisher(Empty, "ask", 10)
    wait_until(lambda: client.service_is_ready() and publisher.get_subscription_count())
    for expected in range(1, 11):
        publisher.publish(Empty())
        wait_until(lambda expected=expected: len(answers) == expected)
    stop(executor, spinner)
    return {"answers": answers}


def spinning_node():
    node, executor = Node("node"), MultiThreadedExecutor(WORKERS)
    executor.add_node(node)
    spinner = threading.Thread(target=executor.spin)
    spinner.start()
    return node, executor, spinner


def stop(executor, spinner):
    executor.shutdown()
    spinner.join()


def wait_until(condition, timeout=20.0):
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.005)


if __name__ == "__main__":
    rclpy.init()
    print(json.dumps(globals()[sys.argv[1]]()), flush=True)
    rclpy.shutdown()

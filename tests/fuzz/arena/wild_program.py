"""A program that does anything that ROS allows, chosen by SEED. It does not solve its exercise.

It runs as a student's. `fuzz.arena.generated_program` puts in SEED, OFFERS and the text of wild_messages.py.
"""

from __future__ import annotations

import os
import random
import subprocess
import sys
import threading
import time
from importlib import import_module

import rclpy
from action_msgs.msg import GoalStatusArray
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile

from fuzz.arena.wild_messages import wild_message

SEED = 0
OFFERS: tuple = ()  # what the exercise asks for, as (service or action, name, type); random ones otherwise

CHANCE = random.Random(SEED)
PERIODS = (0.001, 0.01, 0.1, 0.5)  # s between two acts
NAMES = ("x", "a" * 200, "walk_server", "observer", "robot", "_hidden", "A9", "get_status", "odom")
NO_NAMES = ("", "2nd", "no/name", "ü", "a b", "/", "~", "{x}", "a//b", "\x00")


def find(kind):
    """Return a type by its name."""
    package, folder, name = kind.split("/")
    return getattr(import_module(f"{package}.{folder}"), name)


class Wild:
    """A node and the actions that were drawn for it."""

    def __init__(self):
        self.node = rclpy.create_node(CHANCE.choice(("wild", "observer", "battery_service", "x" * 100)))
        self.group = ReentrantCallbackGroup()
        self.publishers, self.clients, self.kept, self.files = {}, [], [], 0
        self.moods = CHANCE.sample(["wild", "exact", "raises", "none", "slow", "long"], CHANCE.randint(1, 3))
        for what, name, kind in OFFERS:
            if CHANCE.random() < 0.9:
                getattr(self, f"offer_{what}")(name, find(kind))
        acts = [getattr(self, name) for name in dir(self) if name.startswith("act_")]
        self.acts = CHANCE.sample(acts, CHANCE.randint(1, len(acts)))
        self.pause = CHANCE.choice(PERIODS)

    def offer_service(self, name, kind):
        """Respond in an arbitrary way."""

        def answer(request, response):
            mood = CHANCE.choice(self.moods)
            if mood == "raises":
                raise CHANCE.choice((ValueError, KeyError, SystemExit, RuntimeError))("made up")
            if mood == "none":
                return None
            if mood == "slow":
                time.sleep(CHANCE.uniform(0, 3))
            if mood == "long" and hasattr(response, "message"):
                response.message = "m" * CHANCE.choice((1000, 100_000, 5_000_000))
                return response
            return wild_message(type(response), CHANCE) if mood != "exact" else response

        self.node.create_service(kind, name, answer, callback_group=self.group)

    def offer_action(self, name, kind):
        """Accept goals, publish arbitrary feedback, and end the goals in any way or never."""

        def execute(handle):
            for _ in range(CHANCE.choice((0, 1, 10, 300, 3000))):
                handle.publish_feedback(wild_message(kind.Feedback, CHANCE))
                time.sleep(CHANCE.choice((0, 0, 0.01, 0.2)))
            end = CHANCE.choice(("succeed", "abort", "canceled", "", "raise"))
            if end == "raise":
                raise RuntimeError("made up")
            if end:
                getattr(handle, end)()
            return wild_message(kind.Result, CHANCE)

        accepts = (GoalResponse.ACCEPT, GoalResponse.ACCEPT, GoalResponse.REJECT)
        cancels = (CancelResponse.ACCEPT, CancelResponse.REJECT)
        server = ActionServer(
            self.node,
            kind,
            name,
            execute,
            goal_callback=lambda _: CHANCE.choice(accepts),
            cancel_callback=lambda _: CHANCE.choice(cancels),
            callback_group=self.group,
        )
        self.kept.append(server)
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        status = self.node.create_publisher(GoalStatusArray, f"{name}/_action/status", latched)
        feedback = self.node.create_publisher(kind.Impl.FeedbackMessage, f"{name}/_action/feedback", 10)
        self.publishers["status"] = (status, GoalStatusArray)
        self.publishers["feedback"] = (feedback, kind.Impl.FeedbackMessage)

    def offer_client(self, name, kind):
        """Create a client that sends arbitrary requests."""
        self.clients.append((ActionClient(self.node, kind, name), kind))

    def act_send_goals(self):
        """Send goals, request to cancel some, and wait for no answer."""
        for client, kind in self.clients:
            asked = client.send_goal_async(wild_message(kind.Goal, CHANCE), feedback_callback=print)
            if CHANCE.random() < 0.5:
                asked.add_done_callback(lambda done: done.result().cancel_goal_async())

    def act_publish_on_any_topic(self):
        """Publish a message of the right type on an existing topic."""
        names = [(name, types[0]) for name, types in self.node.get_topic_names_and_types() if types]
        if names and len(self.publishers) < 40:
            name, kind = CHANCE.choice(names)
            if name not in self.publishers and "/_action/" not in name:
                self.publishers[name] = (self.node.create_publisher(find(kind), name, 10), find(kind))
        for _ in range(CHANCE.choice((1, 1, 5, 100))):
            if self.publishers:
                publisher, kind = CHANCE.choice(list(self.publishers.values()))
                publisher.publish(wild_message(kind, CHANCE))

    def act_publish_bytes(self):
        """Publish bytes that are not a message."""
        if self.publishers:
            publisher, _ = CHANCE.choice(list(self.publishers.values()))
            publisher.publish(bytes([0, 1, 0, 0]) + CHANCE.randbytes(CHANCE.choice((0, 3, 50, 2000))))

    def act_make_endpoints(self):
        """Create an endpoint with an unusual or invalid name."""
        name = CHANCE.choice(NAMES + NO_NAMES)
        std = import_module("std_srvs.srv").Trigger
        made = CHANCE.choice(("publisher", "subscription", "service", "client", "node"))
        if made == "node":
            self.kept.append(rclpy.create_node(name))
        elif made == "publisher":
            self.kept.append(self.node.create_publisher(GoalStatusArray, name, 1))
        elif made == "subscription":
            self.kept.append(self.node.create_subscription(GoalStatusArray, name, print, 1))
        elif made == "service":
            self.kept.append(self.node.create_service(std, name, lambda _, response: response))
        else:
            self.kept.append(self.node.create_client(std, name))

    def act_destroy_endpoints(self):
        """Destroy an endpoint."""
        if self.kept and isinstance(self.kept[-1], rclpy.node.Node):
            self.kept.pop().destroy_node()

    def act_call_anything(self):
        """Call an existing service without waiting."""
        names = [(name, types[0]) for name, types in self.node.get_service_names_and_types() if types]
        if names:
            name, kind = CHANCE.choice(names)
            if "/srv/" in kind and "_" not in kind.rsplit("/", 1)[1]:
                client = self.node.create_client(find(kind), name)
                client.call_async(wild_message(find(kind).Request, CHANCE))

    def act_write_files(self):
        """Create files, links, pipes and folders wherever it is allowed."""
        self.files += 1
        folder = CHANCE.choice((".", "/tmp", "/dev/shm", "/var/tmp", "/"))
        names = (f"f{self.files}", "arena-1-x", "fastrtps_port7400", "é\n", "sem.x")
        path = os.path.join(folder, CHANCE.choice(names))
        how = CHANCE.choice(("bytes", "hole", "link", "pipe", "folder", "closed"))
        if how == "link":
            os.symlink(CHANCE.choice(("/", "/proc/self/root", path)), path)
        elif how == "pipe":
            os.mkfifo(path)
        elif how == "folder":
            os.makedirs(path + "/d" * 50)
        else:
            with open(path, "wb") as file:
                file.write(CHANCE.randbytes(CHANCE.choice((1, 10_000, 1_000_000))))
                if how == "hole":
                    file.truncate(10_000_000)
            if how == "closed":
                os.chmod(path, 0)

    def act_print(self):
        """Print bytes that are not text, or lines that look like the grader's."""
        printed = (
            CHANCE.randbytes(CHANCE.choice((1, 100, 5000))),
            b'{"kind": "scenario_ended", "t": 1.0}\n',
            b"\x1b[2J\x1b]0;owned\x07passed 10/10\n",
            b"[red]<script>alert(1)</script>\n" * 50,
            b"12 topic a\n",
        )
        stream = CHANCE.choice((sys.stdout, sys.stderr)).buffer
        stream.write(CHANCE.choice(printed))
        stream.flush()

    def act_read_stdin(self):
        """Close stdin or stdout."""
        if CHANCE.random() < 0.05:
            os.close(CHANCE.choice((0, 1)))

    def act_start_processes(self):
        """Start processes that outlive it."""
        if CHANCE.random() < 0.1:
            subprocess.Popen(["sleep", "60"], start_new_session=True)
        if CHANCE.random() < 0.05 and os.fork() == 0:
            time.sleep(60)
            os._exit(0)

    def live(self):
        """Act until the process is ended."""
        while True:
            try:
                CHANCE.choice(self.acts)()
            except Exception as error:
                if CHANCE.random() < 0.05:
                    print(type(error).__name__, str(error)[:100], file=sys.stderr)
            time.sleep(self.pause)


def main():
    """Spin in one thread, and act in another."""
    rclpy.init()
    wild = Wild()
    threading.Thread(target=wild.live, daemon=True).start()
    executor = MultiThreadedExecutor(4)
    executor.add_node(wild.node)
    while rclpy.ok():
        try:
            executor.spin()
        except Exception as error:
            print(error, file=sys.stderr)


if __name__ == "__main__":
    main()

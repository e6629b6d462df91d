"""A server that calls the grader's service, subscribes to its topic and publishes: all of this is recorded."""

from __future__ import annotations

import pytest

from autograder.authoring.checks import Scenario
from autograder.authoring.evidence import events as ev
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.exercise import Exercise
from autograder.isolation.availability import available_isolation

pytestmark = pytest.mark.skipif(
    not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
)
NAME = "battery_service"  # any server: its scenarios and its program are replaced
SCENARIOS = """
from std_msgs.msg import String
from std_srvs.srv import Trigger

from autograder.arena.scripted_service import Reply


def asks_and_tells(stage):
    stage.offer_service("get_status", Trigger, Reply(Trigger.Response(success=True, message="Motors: ON")))
    words = stage.offer_topic("words", String, latched=True)
    words.publish(String(data="good morning"))
    heard, kept = stage.listen("told", String), stage.listen("kept", String, latched=True)
    tell = stage.service("tell", Trigger)
    stage.open()
    tell.call(as_="tell")
    stage.wait_until(lambda: heard.messages and kept.messages, 5.0)
    stage.mark(f"{heard.latest.data} / {kept.latest.data}")
"""
SERVER = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from std_msgs.msg import String
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
rclpy.init()
node = rclpy.create_node("server")
word = Future()
told = node.create_publisher(String, "told", 10)
node.create_publisher(String, "kept", LATCHED).publish(String(data="from the beginning"))
group = ReentrantCallbackGroup()
node.create_subscription(String, "words", word.set_result, LATCHED, callback_group=group)
client = node.create_client(Trigger, "get_status", callback_group=group)


async def on_tell(request, response):
    status = await client.call_async(Trigger.Request())
    told.publish(String(data=f"{(await word).data}, {status.message}"))
    response.success = True
    return response


node.create_service(Trigger, "tell", on_tell, callback_group=group)
rclpy.spin(node)
"""


def test_a_server_uses_the_stages_service_and_topic_and_its_messages_are_recorded(tmp_path) -> None:
    (tmp_path / "scenarios.py").write_text(SCENARIOS)
    exercise = Exercise(NAME, tmp_path, ())
    scenario = Scenario("asks_and_tells", robot=None)
    transcript = run_in_arena(ArenaRun(exercise, {f"{NAME}.py": SERVER.encode()}, scenario))
    assert transcript.first(ev.ScenarioEnded), transcript.output()
    assert transcript.call("tell").response.success
    assert [event.message.data for event in transcript.received("told")] == ["good morning, Motors: ON"]
    assert [event.message.data for event in transcript.received("kept")] == ["from the beginning"]
    assert transcript.mark("good morning, Motors: ON / from the beginning")
    (request,) = transcript.requests("get_status")
    assert request.reply
    (published,) = transcript.published("words")
    assert published.message.data == "good morning"

"""The content of a recording, read by an independent reader."""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.judging import judge
from autograder.engine.verdict import Grade
from autograder.recording.kept import keep
from autograder.recording.mcap_file import MAX_NONESSENTIAL_BYTES
from autograder.recording.recorder import Recorder
from falls import (
    FELL_AT,
    PUSH,
    WALK,
    accepts,
    exercise,
    judged,
    recordings,
    secret,
    simulated,
    stays_up,
    walk,
)
from humanoid_interfaces.action import WalkTo

INFO, WARN, ERROR = 20, 30, 40


def read(folder: Path, content: bytes) -> dict[str, list[tuple[float, str, Any]]]:
    """Every message by its topic, with its time (s) and its type."""
    path = folder / "some.mcap"
    path.write_bytes(content)
    found = defaultdict(list)
    with AnyReader([path]) as reader:
        for connection, at, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            found[connection.topic].append((at / 1e9, connection.msgtype, message))
    return found


@pytest.fixture(scope="module")
def fall() -> tuple[dict[str, bytes], dict[float, np.ndarray]]:
    postures, places = simulated("table")
    return recordings(walk(postures=postures)), places


def test_ground_truth_is_on_the_robots_own_topics_in_its_own_time(fall: Any, tmp_path: Path) -> None:
    files, places = fall
    found = read(tmp_path, files["walk.mcap"])
    types = {topic: messages[0][1] for topic, messages in found.items()}
    assert types["/robot/odom"] == "nav_msgs/msg/Odometry"
    assert types["/robot/joint_states"] == "sensor_msgs/msg/JointState"
    assert types["/robot/objects/cup/pose"] == "geometry_msgs/msg/PoseStamped"
    assert types["/tf"] == "tf2_msgs/msg/TFMessage"
    times = [t for t, _, _ in found["/robot/odom"]]
    assert times == pytest.approx(list(places))
    for (t, _, odom), (_, _, joints), (_, _, tf), qpos in zip(
        *(found[topic] for topic in ("/robot/odom", "/robot/joint_states", "/tf")),
        places.values(),
        strict=True,
    ):
        at = odom.pose.pose.position
        assert [at.x, at.y, at.z] == pytest.approx(qpos[:3], abs=1e-5)
        assert odom.header.stamp.sec + odom.header.stamp.nanosec / 1e9 == pytest.approx(t)
        body, cup = tf.transforms
        assert (body.header.frame_id, body.child_frame_id, cup.child_frame_id) == ("odom", "base_link", "cup")
        assert body.transform.translation.z == at.z
        turned = body.transform.rotation
        assert [turned.w, turned.x, turned.y, turned.z] == pytest.approx(qpos[3:7], abs=1e-5)
        assert len(joints.name) == len(joints.position) == len(joints.velocity)


def test_feedback_and_status_have_their_real_names_and_types(fall: Any, tmp_path: Path) -> None:
    found = read(tmp_path, fall[0]["walk.mcap"])
    ((t, kind, feedback),) = found["/robot/walk_to/_action/feedback"]
    assert (t, kind) == (0.4, "humanoid_interfaces/action/WalkTo_FeedbackMessage")
    assert feedback.feedback.distance_remaining == 0.5
    ((t, kind, status),) = found["/robot/walk_to/_action/status"]
    assert (t, kind) == (0.3, "action_msgs/msg/GoalStatusArray")
    (of_goal,) = status.status_list
    assert of_goal.status == 2
    assert list(of_goal.goal_info.goal_id.uuid) == list(feedback.goal_id.uuid)
    (_, _, sent), (_, _, answered) = found["/robot/walk_to/_action/send_goal/_service_event"]
    assert sent.request[0].goal.target_pose.pose.position.x == 0.75
    assert answered.response[0].accepted
    ((_, _, result),) = found["/robot/walk_to/_action/get_result/_service_event"]
    assert (result.response[0].status, result.response[0].result.error_code) == (6, 1)
    assert [state.mode for _, _, state in found["/robot/robot_state"]] == [1, 3]


def test_a_failed_check_is_an_error_at_its_time_and_a_passed_one_is_not(fall: Any, tmp_path: Path) -> None:
    found = read(tmp_path, fall[0]["walk.mcap"])
    lines = {(line.function or line.name): (t, line.level, line.msg) for t, _, line in found["/rosout"]}
    t, level, text = lines["stays_up"]
    assert (t, level) == (FELL_AT, ERROR)
    assert "a robot that stands" in text
    assert "Keep the motors on." in text
    assert lines["accepts"][:2] == (2.0, INFO)
    assert lines["walker"] == (0.5, WARN, "slow")
    recorded = [line.msg for _, _, line in found["/arena/events"]]
    assert any("goal “first” of walk_to" in text and "max_velocity=0.3" in text for text in recorded)


def test_a_flood_does_not_fill_the_disk_nor_push_out_the_robot(tmp_path: Path) -> None:
    noise = np.random.default_rng(0).integers(97, 122, (600, 30_000), dtype=np.uint8)
    flood = [
        ev.NodeOutput(t=0.6 + number / 1000, stream="stdout", text=letters.tobytes().decode())
        for number, letters in enumerate(noise)
    ]
    run = walk(*flood, postures=simulated()[0])
    content = recordings(run)["walk.mcap"]
    assert len(content) < MAX_NONESSENTIAL_BYTES
    found = read(tmp_path, content)
    assert 100 < len(found["/rosout"]) < 300
    assert any("left out" in line.msg for _, _, line in found["/arena/events"])
    assert len(found["/robot/odom"]) == 50
    assert [t for t, _, line in found["/rosout"] if line.function == "stays_up"] == [FELL_AT]


def test_an_event_that_cannot_be_written_is_the_only_one_missing(tmp_path: Path) -> None:
    broken = WalkTo.Result(error_msg="half a pair: \ud83d")
    run = walk(
        ev.NodeOutput(t=0.7, stream="stdout", text="zero \0 and \ud83d"),
        ev.GoalFinished(t=0.8, goal="unknown", status=4, result=broken),
        ev.ResultReceived(t=0.9, goal="first", status=4, result=broken),
    )
    found = read(tmp_path, recordings(run)["walk.mcap"])
    assert [line.msg for t, _, line in found["/rosout"] if t == 0.7] == ["zero ␀ and ?"]
    assert [t for t, _, _ in found["/robot/walk_to/_action/get_result/_service_event"]] == [1.9]


def test_students_recordings_contain_no_hidden_checks(tmp_path: Path) -> None:
    hidden = dataclasses.replace(secret, hidden=True)
    also_on_walk = dataclasses.replace(accepts, id="unseen", hidden=True)
    whole = exercise(accepts, hidden, also_on_walk)
    run = walk()
    verdicts = [judged(each, run) for each in whole.checks]
    made = {}
    for for_students in (True, False):
        recorder = Recorder(whole, for_students=for_students)
        for verdict in verdicts:
            recorder.add(verdict, [run])
        made[for_students] = recorder.files(Grade("walk_to", "zoe", "namespaces", verdicts))
    assert set(made[True]) == {"walk.mcap"}
    assert set(made[False]) == {"walk.mcap", f"{PUSH.name}.mcap"}
    recorded = {
        for_students: {line.function for _, _, line in read(tmp_path, files["walk.mcap"])["/rosout"]}
        for for_students, files in made.items()
    }
    assert recorded == {True: {"", "accepts"}, False: {"", "accepts", "unseen"}}


def test_the_run_on_which_a_point_was_lost_is_kept_whatever_comes_after(tmp_path: Path) -> None:
    passing, failing = walk(until=2.0), walk(until=3.0)
    first, second, third = accepts, stays_up, dataclasses.replace(accepts, id="accepts_again")
    verdicts = [judged(first, passing), judged(second, failing), judged(third, passing)]
    recorder = Recorder(exercise(first, second, third), for_students=True)
    for verdict, run in zip(verdicts, (passing, failing, passing), strict=True):
        recorder.add(verdict, [run])
    files = recorder.files(Grade("walk_to", "zoe", "namespaces", verdicts))
    lines = [line for _, _, line in read(tmp_path, files["walk.mcap"])["/rosout"] if line.function]
    assert {line.function: "another run" in line.msg for line in lines} == {
        "accepts": True,
        "stays_up": False,
        "accepts_again": True,
    }
    assert read(tmp_path, files["walk.mcap"])["/arena/events"][-1][0] == 3.0


def test_a_verdict_on_two_scenarios_is_in_both_recordings(tmp_path: Path) -> None:
    on_both = dataclasses.replace(stays_up, judge=fall_in_one_of_two, on=(WALK, PUSH))
    runs = [walk(), walk()]
    verdict = judged(on_both, *runs)
    recorder = Recorder(exercise(on_both), for_students=True)
    recorder.add(verdict, runs)
    files = recorder.files(Grade("walk_to", "zoe", "namespaces", [verdict]))
    for name, other in (("walk.mcap", "push_it"), ("push_it.mcap", "walk")):
        lines = [line for _, _, line in read(tmp_path, files[name])["/rosout"] if line.function]
        assert [line.level for line in lines] == [ERROR]
        assert f"judged on {other}, too" in lines[0].msg


def fall_in_one_of_two(first: Transcript, second: Transcript) -> None:
    raise Failure(expected="two that stand", observed="a fall", help="Keep the motors on.", at=FELL_AT)


def test_checks_cannot_detect_whether_a_recording_was_requested() -> None:
    postures, _ = simulated(seconds=0.2)
    with_postures, without = walk(postures=postures), walk()
    assert with_postures.postures
    assert not without.postures
    for field in dataclasses.fields(Transcript):
        if field.name != "postures":
            assert getattr(with_postures, field.name) == getattr(without, field.name), field.name
    assert judge(stays_up, [with_postures]) == judge(stays_up, [without])


def test_recordings_of_an_earlier_grading_are_removed(tmp_path: Path) -> None:
    keep(tmp_path, {"a.mcap": b"old", "b.mcap": b"old"})
    (tmp_path / "notes.txt").write_text("mine")
    keep(tmp_path, {"b.mcap": b"new"})
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {
        "b.mcap": b"new",
        "notes.txt": b"mine",
    }

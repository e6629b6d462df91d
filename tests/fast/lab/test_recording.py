"""The content of a recording, and its plots."""

from __future__ import annotations

import re

import numpy as np
import pytest
from drawings import read
from sensor_msgs.msg import BatteryState, JointState
from stage import Stage

from humanoid_interfaces.msg import RobotState
from lab.errors import LabError
from lab.pictures.plots import plot_curves, plot_means
from ros_runtime.record.client_events import CancelAnswered, CancelSent, FeedbackReceived, ResultReceived


@pytest.fixture
def stage(monkeypatch: pytest.MonkeyPatch) -> Stage:
    return Stage(monkeypatch)


def test_messages_have_their_stamps_as_times_and_those_outside_the_block_are_left_out(stage: Stage) -> None:
    for tenth in range(-2, 14):
        stage.walk(tenth / 10, speed=tenth / 10)
    recording = stage.end(1.05)
    times, speeds = recording.values("speed")
    np.testing.assert_allclose(times, np.arange(11) / 10, atol=1e-6)
    np.testing.assert_allclose(speeds, times, atol=1e-6)
    assert recording.mean("speed") == pytest.approx(0.5)


def test_tilt_is_the_angle_from_upright_whatever_the_heading(stage: Stage) -> None:
    for yaw in (0.0, 1.0, 3.0):
        stage.walk(0.1 + yaw / 10, yaw=yaw, pitch=0.4)
    np.testing.assert_allclose(stage.end(1.0).values("tilt")[1], 0.4, atol=1e-6)


def test_pitch_is_positive_forwards_whatever_the_heading(stage: Stage) -> None:
    for yaw in (0.0, 1.0, 3.0):
        stage.walk(0.1 + yaw / 10, yaw=yaw, pitch=0.3)
        stage.walk(0.5 + yaw / 10, yaw=yaw, pitch=-0.3)
    values = stage.end(1.0).values("pitch")[1]
    np.testing.assert_allclose(np.sort(values), [-0.3] * 3 + [0.3] * 3, atol=1e-6)


def test_the_heading_is_unwrapped(stage: Stage) -> None:
    for step in range(9):
        stage.walk(step / 10, yaw=2.8 + 0.1 * step)
    np.testing.assert_allclose(stage.end(1.0).values("heading")[1], 2.8 + 0.1 * np.arange(9), atol=1e-6)


def test_power_is_positive_while_the_battery_discharges(stage: Stage) -> None:
    stage.publish("battery_state", BatteryState(voltage=50.0, current=-2.0), at=0.5)
    assert stage.end(1.0).mean("power") == pytest.approx(100.0)


def test_a_joint_is_recorded_by_its_name_whatever_its_index(stage: Stage) -> None:
    states = JointState(name=["l_elbow", "head_pan", "r_finger_1"], position=[-0.5, 0.3, 0.02])
    stage.publish("joint_states", states, at=0.2)
    reversed_states = JointState(name=states.name[::-1], position=states.position[::-1])
    stage.publish("joint_states", reversed_states, at=0.4)
    recording = stage.end(1.0)
    np.testing.assert_allclose(recording.values("l_elbow")[1], [-0.5, -0.5])
    drawing = read(recording.plot("head_pan", "r_finger_1"))
    assert {"head_pan, rad", "r_finger_1, m"} <= set(drawing.texts)


def test_a_plot_has_a_panel_for_each_quantity_and_a_label_for_each_moment(stage: Stage) -> None:
    stage.be(RobotState.WALKING, at=-0.1)
    for twentieth in range(40):
        stage.walk(twentieth / 20, speed=0.3 if twentieth < 25 else 0.0)
    stage.recording.add_event(CancelSent(t=1001.0, cancel="cancel 1", goal="turn_to 1", by="notebook"))
    stage.recording.add_event(
        CancelAnswered(t=1001.01, cancel="cancel 1", return_code=0, canceling=["turn_to 1"])
    )
    stage.recording.add_event(FeedbackReceived(t=1001.1, goal="turn_to 1", feedback=None))
    stage.be(RobotState.STANDING, at=1.25)
    stage.recording.add_event(ResultReceived(t=1001.5, goal="turn_to 1", status=5, result=None))
    drawing = read(stage.end(2.0).plot("speed", "height", title="A cancel"))

    labels = ["cancel requested", "cancel accepted", "WALKING → STANDING", "result: CANCELED"]
    for text in (
        *labels,
        "A cancel",
        "speed, m/s",
        "height, m",
        "s since the recording began (system clock)",
    ):
        assert drawing.texts.count(text) == 1, text
    assert not any("feedback" in text for text in drawing.texts)
    assert "speed in m/s: 0.30 at first, 0.00 at last" in drawing.alt
    places = [
        drawing.alt.index(f"{at}: {label}.")
        for at, label in zip(("1.00 s", "1.01 s", "1.25 s", "1.50 s"), labels, strict=True)
    ]
    assert places == sorted(places)


def test_the_time_between_two_moments_can_be_asked_for(stage: Stage) -> None:
    stage.be(RobotState.WALKING, at=-0.1)
    stage.now = 1000.4
    stage.recording.mark("power off")
    stage.be(RobotState.OFF, at=0.5)
    recording = stage.end(1.0)
    assert recording.time_of("OFF") - recording.time_of("power off") == pytest.approx(0.1)
    assert recording.time_of("WALKING → OFF") == recording.time_of("OFF")
    with pytest.raises(
        LabError, match=r'the recorded events are: "power off" at 0\.40 s; "WALKING → OFF" at 0\.50 s'
    ):
        recording.time_of("FALLEN")


def test_a_curve_to_compare_with_is_named_and_does_not_stretch_the_panel(stage: Stage) -> None:
    for twentieth in range(20):
        stage.walk(twentieth / 20)
    recording = stage.end(1.0)
    drawing = read(recording.plot("height", compare={"a stone": lambda t: 0.6 - 4.905 * t * t}))
    assert "a stone" in drawing.texts
    assert "Dashed beside height: a stone." in drawing.alt
    ticks = [float(text.replace("−", "-")) for text in drawing.texts if text.replace("−", "-")[-1:].isdigit()]
    assert min(ticks) >= -0.1


def test_a_curve_to_compare_with_that_goes_a_little_further_is_shown_to_its_end(stage: Stage) -> None:
    for twentieth in range(20):
        stage.walk(twentieth / 20, x=twentieth / 20)
    drawing = read(stage.end(1.0).plot("x", compare={"wanted": lambda t: 1.3 * t}))
    assert {"the robot", "wanted"} < set(drawing.texts)
    ticks = [float(text) for text in drawing.texts if re.fullmatch(r"\d\.\d+", text)]
    assert max(ticks) > 1.2


def test_the_time_between_two_moments_is_coloured_and_measured(stage: Stage) -> None:
    stage.be(RobotState.WALKING, at=-0.1)
    stage.walk(0.5)
    stage.recording.add_event(ResultReceived(t=1000.6, goal="turn_to 1", status=5, result=None))
    stage.be(RobotState.STANDING, at=1.35)
    recording = stage.end(2.0)
    drawing = read(recording.plot("speed", between={"keep away": ("result: CANCELED", "STANDING")}))
    assert "keep away: 0.75 s" in drawing.texts
    assert "Coloured, keep away: 0.75 s from 0.60 s on." in drawing.alt
    with pytest.raises(LabError, match='"FALLEN" did not happen'):
        recording.plot("speed", between={"never": ("STANDING", "FALLEN")})


def test_marks_with_special_characters_are_shown_unchanged(stage: Stage) -> None:
    stage.walk(0.5)
    stage.recording.mark("$x$ < y & z_1")
    assert "$x$ < y & z_1" in read(stage.end(1.0).plot("speed")).texts


def test_an_unknown_quantity_is_refused_with_those_that_there_are(stage: Stage) -> None:
    stage.walk(0.5)
    recording = stage.end(1.0)
    for ask in (recording.values, recording.mean, recording.plot):
        with pytest.raises(
            LabError, match=r"there is no quantity 'sped'; .* \"speed\" \(m/s\), .*\"power\" \(W\)"
        ):
            ask("sped")


def test_an_empty_recording_is_reported(stage: Stage) -> None:
    stage.walk(-0.1)
    recording = stage.end(0.02)
    for ask in (lambda: recording.plot("speed"), lambda: recording.mean("power"), recording.film):
        with pytest.raises(LabError, match=r"was recorded: the block lasted 0\.02 s"):
            ask()
    with pytest.raises(LabError, match="name the quantities to plot"):
        recording.plot()


def test_a_recording_is_complete_when_a_later_message_has_arrived(stage: Stage) -> None:
    stage.walk(0.9)
    recording = stage.end(1.0)
    assert not recording.has_all_messages()
    stage.walk(1.02)
    assert recording.has_all_messages()


def test_means_are_points_with_the_names_of_their_recordings(stage: Stage) -> None:
    stage.walk(0.5, speed=0.25)
    stage.publish("battery_state", BatteryState(voltage=50.0, current=-2.0), at=0.5)
    drawing = read(plot_means({"a walk": stage.end(1.0)}, "speed", "power", title="Power against speed"))
    for text in ("a walk", "mean speed, m/s", "mean power, W", "Power against speed"):
        assert text in drawing.texts
    assert drawing.alt == "Power against speed. a walk: mean speed, m/s 0.25, mean power, W 100.00."
    with pytest.raises(LabError, match="no recording to plot"):
        plot_means({}, "speed", "power")


def test_the_place_of_the_pelvis_can_be_asked_for(stage: Stage) -> None:
    stage.walk(0.2)
    recording = stage.end(1.0)
    assert [len(recording.values(name)[1]) for name in ("x", "y")] == [1, 1]


def test_curves_are_named_and_described_in_words() -> None:
    drawing = read(
        plot_curves(
            {"truth": ([0, 1], [2, 4]), "a guess": ([0, 1], [3, 3])}, "time, s", "way, m", title="Ways"
        )
    )
    for text in ("Ways", "truth", "a guess", "time, s", "way, m"):
        assert text in drawing.texts, text
    assert "truth: way, m from 2.00 at time, s 0.00 to 4.00 at 1.00" in drawing.alt


def test_a_band_shows_where_an_estimate_is_near_the_truth() -> None:
    curves = {
        "a guess": ([0, 1, 2, 3], [9, 5, 3, 1]),
        "a promise": ([0, 1, 2, 3], [1, 1, 1, 8]),
        "truth": ([0, 1, 2, 3], [4, 3, 2.5, 1]),
    }
    drawing = read(plot_curves(curves, "time, s", "left, s", factor=2))
    assert "within a factor of 2" in drawing.texts
    assert "a guess: inside the band from 1.00 to 3.00." in drawing.alt
    assert "a promise: never inside the band." in drawing.alt


@pytest.mark.parametrize(
    ("curves", "said"),
    [
        ({}, "0 curves"),
        ({"a": ([], [])}, "a has 0 values for t and 0 for y"),
        ({"a": ([1], [1, 2])}, "a has 1 values for t and 2 for y"),
    ],
)
def test_invalid_curves_are_refused(curves: dict[str, tuple[list[float], list[float]]], said: str) -> None:
    with pytest.raises(LabError, match=said):
        plot_curves(curves, "t", "y")

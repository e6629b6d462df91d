"""A recording of the running robot: a walk, a goal that is cancelled during the walk, and a fall."""

from __future__ import annotations

import pytest
from kernels import Kernel


@pytest.fixture(scope="module")
def recorded(kernel: Kernel) -> Kernel:
    """A kernel whose `recording` has a walk with a cancelled goal, and after it a fall without torque."""
    kernel.run("""
        import time
        from humanoid_interfaces.action import StandUp
        from std_msgs.msg import Bool
        lab.start_robot()
        server = lab.run_node("riser.py", "cancel")
        with lab.record_robot() as recording:
            with lab.walking(forward=0.3):
                lab.wait_until(lambda: lab.pose().x > 0.4, timeout=20)
                goal = lab.send_goal("stand_up", StandUp, StandUp.Goal())
                goal.cancel()
                goal.result(show_feedback=False)
                recording.mark("motor power off")
                lab.publish("motor_power", Bool(data=False))
                lab.wait_until(lambda: lab.mode() == "FALLEN")
    """)
    return kernel


def test_its_plot_shows_the_robot_and_the_commands(recorded: Kernel) -> None:
    html = recorded.run("print(recording.plot('speed', 'height', title='A walk and its end').data)")
    assert '<img src="data:image/svg+xml;base64,' in html
    labels = ["goal sent", "cancel requested", "cancel accepted", "result: CANCELED", "motor power off"]
    places = [html.index(f"s: {label}.") for label in labels]
    assert places == sorted(places)
    assert "STANDING → WALKING" in html
    assert "→ FALLEN" in html


def test_a_recording_spans_the_whole_block(recorded: Kernel) -> None:
    recorded.run("""
        times, speeds = recording.values("speed")
        assert (times[1:] > times[:-1]).all()
        assert times[0] < 0.5 and recording.seconds - times[-1] < 0.5, (times[0], times[-1], recording.seconds)
        assert speeds.max() > 0.2
        heights = recording.values("height")[1]
        assert heights[0] > 0.5 and heights[-1] < 0.5
        assert recording.mean("power") > 0
        assert recording.time_of("goal sent") < recording.time_of("result: CANCELED")
    """)


def test_its_film_is_drawn_afterwards(recorded: Kernel) -> None:
    html = recorded.run("""
        from pathlib import Path
        print(recording.film('fall.webp', camera='side', slow_motion=2).data, Path('fall.webp').is_file())
    """)
    assert "slowed down 2 times" in html
    assert ("data:image/webp" in html and html.endswith(" True\n")) or "No film: no OpenGL" in html


def test_a_time_line_shows_the_server_and_its_end(recorded: Kernel) -> None:
    recorded.run("server.stop()")
    html = recorded.run("print(lab.draw_timeline(server, title='The server').data)")
    assert "The server. riser.py began at 0.00 s;" in html
    assert " s: stopped." in html


def test_without_a_robot_recording_is_refused(kernel: Kernel) -> None:
    kernel.run("lab.stop_robot(); lab.client.topics.reset_for_scene('flat')")
    printed = kernel.run("""
        try:
            with lab.record_robot():
                pass
        except lab.NoRobotError as error:
            print(error)
    """)
    assert "no message arrived on /robot/robot_state" in printed


def test_the_cup_and_the_grip_are_recorded_at_the_table(own_kernel: Kernel) -> None:
    own_kernel.run("""
        import time
        from std_msgs.msg import Float64
        lab.start_robot("table")
        with lab.record_robot() as recording:
            lab.publish("r_gripper/command", Float64(data=0.06))
            time.sleep(2)
        assert abs(recording.values("cup height")[1][-1] - 0.755) < 0.005
        assert recording.values("grip")[1][-1] == 0.0
        assert abs(recording.values("r_finger_1")[1][-1] - 0.03) < 0.005
    """)
    assert "The robot and the cup for" in own_kernel.run("print(recording.film().data)")
    assert "STANDING" in own_kernel.run("print(lab.show_robot().data)")

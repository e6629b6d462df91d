"""The robot of a notebook: its start, its pictures, and its end with the kernel."""

from __future__ import annotations

import re
import signal
import time

import psutil
import pytest
from kernels import CellError, Kernel

from ros_runtime.notebook_domains import lab_variables


@pytest.fixture(scope="module")
def robot(kernel: Kernel) -> Kernel:
    kernel.run("lab.start_robot()")
    return kernel


def test_starting_twice_keeps_the_robot(robot: Kernel) -> None:
    before = robot.children()
    printed = robot.run("lab.start_robot()")
    assert before
    assert robot.children() == before
    assert "The robot is up in namespace /robot" in printed


def test_it_walks_during_the_block_and_its_pose_is_read(robot: Kernel) -> None:
    printed = robot.run("""
        lab.restart_robot()
        print(lab.mode(), lab.robot_state().motors_enabled)
        with lab.walking(forward=0.3):
            lab.wait_until(lambda: lab.pose().x > 0.3, timeout=20)
            print(lab.mode())
        lab.wait_until(lambda: lab.mode() == "STANDING")
        print(lab.battery().percentage < 1.0, lab.battery().current < 0.0)
    """)
    assert printed.splitlines()[1:] == ["STANDING True", "WALKING", "True True"]


def test_a_restarted_robot_stands_at_the_origin(robot: Kernel) -> None:
    robot.run("from std_msgs.msg import Bool\nlab.publish('motor_power', Bool(data=False))")
    robot.run("lab.wait_until(lambda: lab.mode() == 'FALLEN')")
    assert "It lies: lab.restart_robot() sets it up again." in robot.run("lab.start_robot()")
    printed = robot.run("lab.restart_robot(); print(lab.mode(), abs(lab.pose().x) < 0.05)")
    assert printed.splitlines()[-1] == "STANDING True"


def test_its_picture_has_an_alternative_text(robot: Kernel) -> None:
    html = robot.run("print(lab.show_robot().data)")
    assert 'alt="The robot: STANDING at x ' in html or "No picture: no OpenGL" in html


def test_it_is_watched_while_it_walks(robot: Kernel) -> None:
    kind = robot.run("view = lab.watch_robot(); print(type(view).__name__)").strip()
    if kind == "Label":
        pytest.skip(robot.run("print(view.value)"))
    robot.run("""
        frames = set()
        view.observe(lambda change: frames.add(change["new"]), "value")
        with lab.walking(forward=0.3):
            lab.wait_until(lambda: len(frames) >= 5, timeout=20)
        lab.stop_watching()
        seen = len(frames)
    """)
    seen = robot.run("print(len(frames) == seen, next(iter(frames))[:2] == bytes((0xff, 0xd8)))")
    assert seen == "True True\n"


def test_a_robot_that_stands_still_is_not_drawn_again(robot: Kernel) -> None:
    kind = robot.run("lab.restart_robot(); view = lab.watch_robot(); print(type(view).__name__)")
    if "Label" in kind:
        pytest.skip(robot.run("print(view.value)"))
    frames = robot.run("""
        import time
        frames = []
        view.observe(lambda change: frames.append(change["new"]), "value")
        time.sleep(2)
        standing = len(frames)
        with lab.walking(forward=0.3):
            lab.wait_until(lambda: len(frames) > standing, timeout=20)
        lab.stop_watching()
        print(standing)
    """)
    assert frames == "0\n"


def test_a_camera_that_does_not_exist_is_refused(robot: Kernel) -> None:
    with pytest.raises(CellError, match="camera 'roof' is not known; choose one of track"):
        robot.run("lab.watch_robot('roof')")


def test_after_a_stop_the_error_comes_at_once(kernel: Kernel) -> None:
    kernel.run("lab.start_robot(); lab.stop_robot()")
    with pytest.raises(CellError, match=r"the robot was stopped: lab.start_robot\(\)"):
        kernel.run("lab.mode()")


def test_stop_everything_leaves_no_process_and_can_start_again(kernel: Kernel) -> None:
    kernel.run("lab.start_robot(); lab.run_node('adder.py')")
    assert len(kernel.children()) == 2
    kernel.run("lab.stop_everything()")
    assert kernel.children() == []
    assert "The robot is up" in kernel.run("lab.start_robot()")


def test_interrupting_a_cell_harms_neither_robot_nor_node(own_kernel: Kernel) -> None:
    own_kernel.run("lab.start_robot(); node = lab.run_node('adder.py')")
    before = own_kernel.children()
    waiting = "lab.wait_until(lambda: False, 60, print('waiting', flush=True) or 'never')"
    own_kernel.client.execute(waiting)
    _await_output(own_kernel, "waiting")
    own_kernel.manager.interrupt_kernel()
    reply = own_kernel.client.get_shell_msg(timeout=30)["content"]
    assert reply["ename"] == "KeyboardInterrupt"
    where, what = reply["traceback"]
    assert re.fullmatch(rf"Cell In\[\d+\], line 1: {re.escape(waiting)}", where)
    assert what == "KeyboardInterrupt: interrupted"
    assert own_kernel.run("print(node.is_running, lab.mode())") == "True STANDING\n"
    assert own_kernel.children() == before


@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGTERM])
def test_nothing_survives_the_kernel(own_kernel: Kernel, end: signal.Signals) -> None:
    own_kernel.run("lab.start_robot(); lab.run_node('adder.py')")
    children = own_kernel.children()
    own_kernel.process.send_signal(end)
    _, alive = psutil.wait_procs(children, timeout=10)
    assert len(children) == 2
    assert alive == []


def test_robots_of_two_kernels_are_separate(kernel: Kernel, own_kernel: Kernel) -> None:
    question = "print(lab.client.connection.connection().domain_id)"
    assert kernel.run(question) != own_kernel.run(question)


def test_another_notebook_of_the_lab_takes_the_robot_over(kernel: Kernel, own_kernel: Kernel) -> None:
    [(variable, file)] = lab_variables().items()
    for name, notebook in (("first", kernel), ("second", own_kernel)):
        notebook.run(f"""
            import os
            os.environ.update({{"{variable}": "{file}", "JPY_SESSION_NAME": "/home/me/{name}.ipynb"}})
            lab.stop_everything()
        """)
    assert "has ended" not in kernel.run("lab.start_robot()")
    assert "The robot of first.ipynb has ended" in own_kernel.run("lab.start_robot()")
    end = "print(lab.running.robot._robot.exit_status)"
    assert kernel.run(end) == "0\n"
    with pytest.raises(
        CellError, match=r"ended when second.ipynb started one: .* lab.start_robot\(\) brings"
    ):
        kernel.run("import time; time.sleep(1.2); lab.pose()")
    assert "The robot of second.ipynb has ended" in kernel.run("lab.start_robot(); lab.pose()")
    assert own_kernel.run(end) == "0\n"


def _await_output(kernel: Kernel, text: str, timeout: float = 30.0) -> None:
    deadline = time.monotonic() + timeout
    while time.monotonic() < deadline:
        message = kernel.client.get_iopub_msg(timeout=timeout)
        if text in message["content"].get("text", ""):
            return
    raise AssertionError(f"the kernel has not printed {text!r}")

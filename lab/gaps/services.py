"""Chapter 2: services."""

from std_srvs.srv import Trigger

from lab.gap import Gap, expect
from lab.gap_checks import ask
from lab.robot import stop_robot
from lab.student_nodes import run_node


def answers_without_odom() -> str:
    """Ask for the position while no robot publishes odom."""
    stop_robot()
    server = run_node("where_am_i_fixed.py")
    hints = {"'NoneType' object": "return response inside the `if`: without it the callback goes on to odom"}
    response = ask(server, "where_am_i", Trigger, hints=hints)
    expect(
        not response.success,
        seen="success=True without one message on odom",
        expected="success=False",
        next="set response.success = False before you return",
    )
    expect(
        response.message,
        seen="an empty message",
        expected="a sentence for people that says why",
        next="set response.message",
    )
    return f"without odom it answered success=False, {response.message!r}, and still runs"


GAPS = (Gap("where_am_i_fixed.py", answers_without_odom),)

"""The source notebooks run on a live robot, with the reference solution in them."""

from __future__ import annotations

import math
import os
import re
from pathlib import Path

import nbformat
from nbclient import NotebookClient

from ros_cli.real_ros2 import path_with_ros2

SOLUTIONS = Path(__file__).resolve().parents[3] / "solutions"
CELL_TIMEOUT = 300  # s, for a self-check on a busy machine


def run(exercise, folder, until=None):
    """Execute a source notebook up to the cell with that id; return the output and result of each cell by its id."""
    notebook = nbformat.read(SOLUTIONS / exercise / f"{exercise}.ipynb", as_version=4)
    ids = [cell.id for cell in notebook.cells]
    notebook.cells = notebook.cells[: ids.index(until) if until else None]
    client = NotebookClient(notebook, timeout=CELL_TIMEOUT, resources={"metadata": {"path": str(folder)}})
    client.execute(env={**os.environ, "PATH": path_with_ros2(os.environ["PATH"])})  # as in `course lab`
    return {cell.id: _text(cell.outputs) for cell in notebook.cells if cell.cell_type == "code"}


def _text(outputs):
    return "\n".join(
        output.text if output.output_type == "stream" else output.data["text/plain"] for output in outputs
    )


def test_battery_service_from_the_task_to_the_verdicts(tmp_path):
    seen = run("battery_service", tmp_path)
    assert "at x " in seen["example-again"] or "no odom yet" in seen["example-again"]
    assert re.search(r"before the first message: available False, battery \(voltage", seen["try"])
    assert re.search(r"after it: available True, battery \(voltage", seen["try"])
    assert "✓" in seen["self-check"]
    assert "✗" not in seen["self-check"]
    assert "The node offers get_battery_status" in seen["server_appears"]
    assert seen["hidden_1"].strip() == "Hidden check 1 is run when your work is graded."


def test_compute_ik_from_the_task_to_the_arm(tmp_path):
    seen = run("compute_ik", tmp_path, until="self-check-intro")
    assert "knees at 0.960 rad" in seen["example-run"]
    assert "not 0.90" in seen["example-run"]
    assert "knees at 0.902 rad" in seen["example-again"]
    assert "code 1, shoulder 14.54°, elbow 49.46°" in seen["try"]
    assert "code 1, shoulder 59.20°, elbow -49.46°" in seen["try"]
    assert "code -31" in seen["try"]
    assert "code 1" in seen["try-arm"]


def test_joint_query_on_the_live_robot(tmp_path):
    seen = run("joint_query", tmp_path, until="self-check-intro")
    assert "m/s² along z" in seen["example-again"] or "no imu yet" in seen["example-again"]
    assert "name=['r_elbow', 'l_knee']" in seen["try"]
    assert "success=False, message='unknown joints: tail_yaw, l_wing_roll'" in seen["try-unknown"]


def test_motor_services_on_the_stand_and_on_the_floor(tmp_path):
    seen = run("motor_services", tmp_path, until="self-check-intro")
    assert "Gaze: AHEAD" in seen["example-run"]
    assert "Gaze: DOWN" in seen["example-again"]
    assert seen["try"].count("Motors: ON") == 2
    assert seen["try"].index("Motors: OFF") > seen["try"].index("power off was sent")
    assert "refused" in seen["try-walking"]
    assert "the robot is WALKING" in seen["try-walking"]


def test_patterns_from_the_task_to_the_verdicts(tmp_path):
    seen = run("patterns", tmp_path)
    assert "odom" in seen["example"]
    assert "12 action c" in seen["try"]
    assert "Situation 6" in seen["self-check"]
    assert "✗" not in seen["self-check"]


def test_arm_architecture_is_drawn_and_asked_for_what_is_missing(tmp_path):
    seen = run("arm_architecture", tmp_path)
    assert "HTML object" in seen["sample-a-draw"]
    assert "arm_architecture.txt: 11 nodes, 13 links\n  Every link has all six facts." in seen["look"]
    assert "HTML object" in seen["look"]


def test_robot_controller_without_servers_with_good_ones_and_with_silent_ones(tmp_path):
    seen = run("robot_controller", tmp_path, until="self-check-intro")
    assert "nobody offers get_battery_status" in seen["example-run"]
    assert "exit status 1" in seen["try-alone"]
    assert "Robot status: Motors: ON" in seen["try"]
    assert "enable_motors does not answer" in seen["try-silent"]
    assert seen["try-silent"].count("enable_motors: True") == 2


def test_battery_guard_with_four_batteries(tmp_path):
    seen = run("battery_guard", tmp_path, until="self-check-intro")
    assert "sent 0.2, arrived 0.200000003: low False, a percentage True" in seen["example"]
    lasts, drops, low, to_100 = re.findall(r"from [\d.]+: .*?(?=\nfrom|$)", seen["try"], re.DOTALL)
    assert "SUCCEEDED" in lasts
    assert "CANCELED: the battery is at 0.18" in drops
    assert "not sent: the battery is at 0.1" in low
    assert "no percentage on battery_state" in to_100


def test_interfaces_from_the_task_to_the_verdicts(tmp_path):
    seen = run("interfaces", tmp_path)
    assert "ReachPoint" in seen["example-run"]
    assert "'available': 'boolean'" in seen["try-use"]
    assert "NavigateToPose.action builds" in seen["self-check"]
    assert "✗" not in seen["self-check"]


def test_cancellable_walk_on_the_live_robot(tmp_path):
    seen = run("cancellable_walk", tmp_path, until="self-check-intro")
    assert "2.00 m forward, 0.00 m to the left" in seen["example-frames"]
    assert "goal 1 gives way" in seen["example-turns"]
    assert "goal 2 has arrived" in seen["example-turns"]
    assert "CANCELED" in seen["try-cancel"]


def test_walk_to_on_the_live_robot(tmp_path):
    seen = run("walk_to", tmp_path, until="self-check-intro")
    assert "2.00 m forward, 0.00 m to the left" in seen["example-frames"]
    assert "plain difference -6.00 rad, wrapped 0.28 rad" in seen["example-wrap"]
    assert "SUCCEEDED" in seen["try-walk"]
    assert 0.12 < float(re.search(r"0\.6 m: ([\d.]+) m/s", seen["try-walk"])[1]) < 0.2  # asked for 0.15
    assert re.search(r"rejected, 0 feedback messages.*\n+.*goal rejected: ", seen["try-nowhere"])


BIAS = ((r"(?s).*bias x (-?[\d.]+)", "try"), (r"\bx: (-?[\d.e-]+)", "try-bias"))


def test_calibration_on_a_standing_and_on_a_walking_robot(tmp_path):
    seen = run("calibration", tmp_path, until="self-check-intro")
    assert re.search(r"\d+ messages in a second", seen["example-run"])
    assert seen["try"].count("success=True") == 1
    found, latched = (float(re.search(pattern, seen[cell])[1]) for pattern, cell in BIAS)
    assert abs(found - latched) < 1e-4
    assert 8 < float(re.search(r"average rate: ([\d.]+)", seen["try-bias"])[1]) < 12
    assert "success=False" in seen["try-walking"]


def test_walk_client_alone_and_with_a_server(tmp_path):
    seen = run("walk_client", tmp_path, until="self-check-intro")
    assert "nobody offers walk_to" in seen["example-run"]
    alone, with_a_server = seen["try"].split("with a server:")
    assert "exit status 1" in alone
    assert re.search(r"exit status 0.*0\.8.*0\.2.*SUCCEEDED", with_a_server, re.DOTALL)
    assert "exit status 2" in seen["try-arguments"]
    assert "usage" in seen["try-arguments"]


def test_cancel_client_with_a_q_and_without(tmp_path):
    seen = run("cancel_client", tmp_path, until="self-check-intro")
    assert "2 ['q\\n', 'end of input']" in seen["example-run"]
    assert re.search(r"CANCELED.* x 0\.[46].*exit status 4", seen["try"], re.DOTALL)
    assert re.search(r"exit status 0.*SUCCEEDED", seen["try-nobody-types"], re.DOTALL)


def test_navigate_to_pose_on_the_live_robot(tmp_path):
    seen = run("navigate_to_pose", tmp_path, until="self-check-intro")
    assert "in legs 2.0" in seen["example-path"]
    assert "the walk takes 6.7 s, the turns 9.0 s, together 15.7 s" in seen["example-time"]
    assert "SUCCEEDED" in seen["try-result"]
    assert 1.1 < float(re.search(r"distance_traveled ([\d.]+)", seen["try-result"])[1]) < 1.7
    place = re.search(r"stands at x (-?[\d.]+) m, y (-?[\d.]+) m, heading (-?\d+)°", seen["try-result"])
    x, y, degrees = map(float, place.groups())
    assert math.dist((x, y), (-1.0, 1.0)) < 0.12  # the tolerance, and two decimals
    assert abs(degrees) < 10


def test_stand_up_on_the_live_robot(tmp_path):
    seen = run("stand_up", tmp_path, until="self-check-intro")
    assert "120 and 252 N: 0.48 stop" in seen["example-loads"]
    assert "0.8 s: even for 0.3 s -> rise" in seen["example-row"]
    assert "base_link is at 0.4" in seen["try-start"]
    phases = re.findall(r"'(shifting|rising|settling)'", seen["try-walk"])
    # A delayed subscriber can miss a short phase.
    assert re.search("rising.*shifting.*settling", " ".join(phases))
    assert "SUCCEEDED" in seen["try-result"]
    assert "ALREADY_STANDING" in seen["try-result"] or "stands already" in seen["try-result"]


def test_balance_controller_on_the_live_robot(tmp_path):
    seen = run("balance_controller", tmp_path, until="self-check-intro")
    assert "a tempo of 0 would never tick" in seen["example-run"]
    assert "120.0" in seen["example-run"]
    assert "has to be above 51.0" in seen["try"] or "out of range" in seen["try"]
    assert "kp_pitch: 340.0" in seen["try"]
    assert "successful False" in seen["try-atomic"]
    assert "302.0" in seen["try-atomic"]


def test_move_arm_on_the_live_robot(tmp_path):
    seen = run("move_arm", tmp_path, until="self-check-intro")
    assert "after 1.0 s at -1.0 rad" in seen["example-straight"]
    assert "2.0 s: l_elbow -1.5, r_elbow -1.0" in seen["example-merge"]
    assert "SUCCEEDED" in seen["try-move"]
    assert "reject" in seen["try-range"].lower()


def test_pick_and_place_on_the_live_robot(tmp_path):
    seen = run("pick_and_place", tmp_path, until="self-check-intro")
    assert "command 35 mm: 10.0 N" in seen["example-force"]
    assert "command 35 mm: 10.0 N" in seen["example-missing"]
    assert "back 0.04 m, on 0.08 m: put it back" in seen["example-nearer"]
    assert "SUCCEEDED" in seen["try-fetch"]
    assert "UNREACHABLE" in seen["try-far"] or "error_code 2" in seen["try-far"]


def test_low_battery_fetch_with_three_batteries(tmp_path):
    seen = run("low_battery_fetch", tmp_path, until="self-check-intro")
    assert "SUCCEEDED" in seen["example-run"]
    assert "total_steps 3" in seen["example-run"]
    lasts, walks, holds = re.findall(r"from [\d.]+: (.*)", seen["try"])
    assert re.match(r"SUCCEEDED .*final_object_pose \(0\.40 m.*max_grasp_force 12", lasts)
    for early in (walks, holds):
        assert re.match(r"ABORTED .*error_msg 'gave up: the battery got low'", early)
    assert "max_grasp_force 0" in walks  # the hand was empty
    assert re.search(r"final_object_pose \(1\.45 m.*max_grasp_force 12", holds)  # on the tray

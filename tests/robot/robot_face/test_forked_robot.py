"""A robot that runs in a fork of the process in which it was built, as arenas start it."""

import json
import os
import signal
import subprocess
import sys

from robot_process import TIMEOUT

from ros_runtime.environment import ros_environment
from ros_runtime.ros_domain import ReservedDomain

BUILD_FORK_AND_SERVE = """
import os, sys
from robot_sim.ros.serve import build_humanoid, parse_options, serve_robot
built = build_humanoid(parse_options(sys.argv[1:]))
robot = os.fork()
if robot == 0:
    serve_robot(parse_options(sys.argv[1:]), built)
    sys.exit(7)
print(robot, flush=True)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(robot, 0)[1]))
"""


def test_a_forked_robot_publishes_executes_commands_and_ends_at_sigterm():
    truth_read, truth_write = os.pipe()
    control_read, control_write = os.pipe()
    pipes = ("--ground-truth-fd", str(truth_write), "--control-fd", str(control_read))
    with (
        ReservedDomain() as domain,
        subprocess.Popen(
            [sys.executable, "-c", BUILD_FORK_AND_SERVE, *pipes, "--scene", "flat", "--seed", "5"],
            env={**os.environ, **ros_environment(), "ROS_DOMAIN_ID": str(domain)},
            pass_fds=(truth_write, control_read),
            stdout=subprocess.PIPE,
            text=True,
        ) as parent,
    ):
        os.close(truth_write)
        os.close(control_read)
        robot = int(parent.stdout.readline())
        with os.fdopen(truth_read) as lines:
            records = map(json.loads, lines)
            assert next(records)["kind"] == "robot_ready"
            os.write(control_write, b'{"do": "motor_power", "on": false}\n')
            assert any(record["kind"] == "robot_commanded" for record in records)
            assert not next(r for r in records if r["kind"] == "robot_truth")["motors_enabled"]
            os.kill(robot, signal.SIGTERM)
            for _ in records:  # read to the end of the pipe
                pass
        assert parent.wait(TIMEOUT) == 7, "what comes after serve_robot is reached"
    os.close(control_write)

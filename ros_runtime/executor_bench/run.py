"""One run under one clock: `python -m ros_runtime.executor_bench.run SCALE [cancel]`

Prints the client's measurements and the server's CPU time as JSON, or {"problem": ...}.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any

from ros_runtime.clock import ScaledClock
from ros_runtime.environment import python_for_ros, ros_environment

TIMEOUT_S = 60.0  # real


def run(scale: float, *, cancel: bool) -> dict[str, Any]:
    """Send one goal at `scale`, which the clock takes up when all three processes are connected."""
    with tempfile.TemporaryDirectory() as directory:
        clock = ScaledClock.create(Path(directory) / "clock")
        environment = os.environ | ros_environment(localhost_only=True, log_directory=Path(directory))
        environment |= clock.environment()
        server = _start(environment, "server")
        traffic = _start(environment, "traffic")
        client = _start(environment, "client", *(["cancel"] if cancel else []))
        too_late = threading.Timer(TIMEOUT_S, client.kill)
        too_late.start()
        try:
            measured = _drive(client, clock, scale)
        finally:
            too_late.cancel()
            client.kill()
            client.wait()
            server_cpu = _stop(server)
            _stop(traffic)
        return measured | {"server_cpu_s": server_cpu}


def _start(environment: dict[str, str], *role: str) -> subprocess.Popen[str]:
    command = [python_for_ros(), "-m", "ros_runtime.executor_bench.nodes", *role]
    return subprocess.Popen(
        command, env=environment, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )


def _drive(client: subprocess.Popen[str], clock: ScaledClock, scale: float) -> dict[str, Any]:
    assert client.stdin is not None
    assert client.stdout is not None
    if client.stdout.readline() != "ready\n":
        return {"problem": f"the three processes did not find each other within {TIMEOUT_S} s"}
    clock.run_at(scale)
    client.stdin.write("\n")
    client.stdin.flush()
    line = client.stdout.readline()
    return json.loads(line) if line else {"problem": "the client got no answer"}


def _stop(process: subprocess.Popen[str]) -> float:
    """End a process as a user would; returns the CPU time it took in all, in s."""
    process.send_signal(signal.SIGINT)
    killer = threading.Timer(5.0, process.kill)
    killer.start()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    killer.cancel()
    return usage.ru_utime + usage.ru_stime


if __name__ == "__main__":
    print(json.dumps(run(float(sys.argv[1]), cancel="cancel" in sys.argv[2:])))

"""Run one sound MultiThreadedExecutor server many times, with or without the repair, and print its pace."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from statistics import median
from typing import Any

from ros_runtime.environment import python_for_ros

FAIR_HZ = (4.0, 6.0)
COLUMNS = {
    "feedback_hz": "Hz",
    "max_gap_s": "max gap s",
    "accept_s": "accept s",
    "result_s": "result s",
    "cancel_s": "cancel s",
    "server_cpu_s": "CPU s",
}


def main() -> None:
    """Print one line a run and a summary for each scale; exit 1 if a run was not fair."""
    parser = argparse.ArgumentParser(prog="python -m ros_runtime.executor_bench", description=__doc__)
    parser.add_argument("--runs", type=int, default=10, help="runs at each scale (default: 10)")
    parser.add_argument("--scale", type=float, action="append", help="pace of the clock; may be repeated")
    parser.add_argument("--without-repair", action="store_true", help="leave rclpy as it is")
    parser.add_argument("--busy-loops", type=int, default=0, help="processes that burn a core each beside it")
    options = parser.parse_args()
    all_fair = True
    for scale in options.scale or [1.0]:
        print("run    scale " + "".join(f"{title:>11}" for title in COLUMNS.values()), flush=True)
        runs = []
        with _busy_loops(options.busy_loops):
            for number in range(options.runs):
                runs.append(_run(scale, cancel=number % 3 == 2, repaired=not options.without_repair))
                print(f"{number + 1:3} {scale:8g} {_line(runs[-1])}", flush=True)
        print(_summary(runs), flush=True)
        all_fair &= all(map(_is_fair, runs))
    sys.exit(not all_fair)


def _run(scale: float, *, cancel: bool, repaired: bool) -> dict[str, Any]:
    """One run in a process of its own, in a private network where bubblewrap can make one."""
    command = [python_for_ros(), "-m", "ros_runtime.executor_bench.run", str(scale)]
    if cancel:
        command.append("cancel")
    if shutil.which("bwrap"):
        command = ["bwrap", "--dev-bind", "/", "/", "--unshare-net", "--die-with-parent", *command]
    environment = os.environ | {"RCLPY_REPAIRS": "on" if repaired else "off"}
    done = subprocess.run(command, env=environment, text=True, stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)


@contextmanager
def _busy_loops(count: int) -> Iterator[None]:
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def _is_fair(run: dict[str, Any]) -> bool:
    return run.get("right_status", False) and FAIR_HZ[0] <= run["feedback_hz"] <= FAIR_HZ[1]


def _line(run: dict[str, Any]) -> str:
    if "problem" in run:
        return run["problem"]
    figures = "".join(" " * 11 if run[name] is None else f"{run[name]:11.3f}" for name in COLUMNS)
    return figures + ("" if _is_fair(run) else "   NOT FAIR")


def _summary(runs: list[dict[str, Any]]) -> str:
    fair = sum(map(_is_fair, runs))
    lines = [f"{fair} of {len(runs)} with {FAIR_HZ[0]:g}-{FAIR_HZ[1]:g} Hz of feedback and the right status"]
    for name, title in COLUMNS.items():
        values = [run[name] for run in runs if run.get(name) is not None]
        if values:
            spread = f"{min(values):.3f} / {median(values):.3f} / {max(values):.3f}"
            lines.append(f"  {title:9} least, median, most: {spread}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()

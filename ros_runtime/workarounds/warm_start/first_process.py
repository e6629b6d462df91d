"""The first process of an arena: it loads rclpy once, for the waiting interpreter and for the leading program.

Run as `python first_process.py DESCRIPTOR`, in the environment of students' programs. It forks the waiting interpreter
and only then reads the file DESCRIPTOR: a JSON object with the leading program's `arguments` (-m MODULE …) and
`environment`. So the waiting interpreter's memory never contains anything of the leading program. The leading program
finds the interpreter's socket and process id in the variable WAITING.
"""

from __future__ import annotations

import sys

FRESH = frozenset(sys.modules)  # what a fresh interpreter has loaded

from ros_runtime.workarounds.warm_start.hidden_imports import Recording, hide  # noqa: E402

with Recording() as recording:
    import gc
    import json
    import os
    import runpy
    import signal
    import socket

    from ros_runtime.workarounds.warm_start import WAITING
    from ros_runtime.workarounds.warm_start.lttng import ForkGuard
    from ros_runtime.workarounds.warm_start.preload import preload
    from ros_runtime.workarounds.warm_start.program import run_program
    from ros_runtime.workarounds.warm_start.starter import wait_for_order


def wait(orders: socket.socket, guard: ForkGuard) -> int:
    """Serve orders with all other descriptors closed. Returns only in a fork: the exit status of its program."""
    here = orders.fileno()
    os.closerange(3, here)
    os.closerange(here + 1, os.sysconf("SC_OPEN_MAX"))
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    os.dup2(nothing, 1)
    os.close(nothing)
    hide(recording, FRESH)
    gc.collect()
    gc.disable()
    gc.freeze()  # so that the forks go on sharing these pages
    order = wait_for_order(orders, guard)
    return run_program(order["argv"], order["env"], order["folder"])


def lead(descriptor: int, waiting: str) -> None:
    """Become `python -m MODULE …`, with the arguments and the environment in the file."""
    with open(descriptor, encoding="utf-8") as file:
        program = json.load(file)
    os.environ.clear()
    os.environ.update(program["environment"])
    os.environ[WAITING] = waiting
    sys.path[:1] = filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))
    dash_m, module, *sys.argv[1:] = program["arguments"]
    assert dash_m == "-m"
    runpy.run_module(module, run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    # A script's background process ignores SIGINT: restore Python's handler.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with recording:
        preload()
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    guard = ForkGuard()
    guard.before()
    pid = os.fork()
    if pid == 0:
        guard.after_in_child()
        sys.exit(wait(theirs, guard))
    guard.after_in_parent()
    theirs.close()
    lead(int(sys.argv[1]), f"{ours.fileno()} {pid}")

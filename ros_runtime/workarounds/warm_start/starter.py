"""A waiting interpreter: for every order it forks a program into a sandbox.

An order is a JSON object (sandbox, argv, env, folder, limits, clock) with five descriptors: stdin, stdout, stderr, a
pipe for the report, and a file with the seccomp filter. The report has two lines, the program's process id and, after
its end, its exit status (negative: a signal); or one line with an error. The program can read this process's whole
memory, so nothing secret may be loaded here.
"""

from __future__ import annotations

import json
import os
import signal
import socket

from ros_runtime.workarounds.scaled_clock.clock import follow
from ros_runtime.workarounds.warm_start.confinement import give_up_privileges, join_namespaces
from ros_runtime.workarounds.warm_start.lttng import ForkGuard

LONGEST_ORDER = 65536  # bytes
DESCRIPTORS = 5


def wait_for_order(orders: socket.socket, guard: ForkGuard) -> dict:
    """Serve orders; return only in a fork that will become a program, with its order."""
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # the kernel reaps the forks
    while True:
        text, descriptors, _, _ = socket.recv_fds(orders, LONGEST_ORDER, DESCRIPTORS)
        if not text:
            os._exit(0)
        guard.before()
        if os.fork() == 0:
            orders.close()
            return keep(json.loads(text), descriptors, guard)
        guard.after_in_parent()
        for descriptor in descriptors:
            os.close(descriptor)


def keep(order: dict, descriptors: list[int], guard: ForkGuard) -> dict:
    """Enter the sandbox and fork the program, in which this returns; report to the arena until the program ends."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    *streams, report, filter_file = descriptors
    seccomp_filter = os.pread(filter_file, os.fstat(filter_file).st_size, 0)
    os.close(filter_file)
    os.setsid()
    try:
        join_namespaces(order["sandbox"])
        pid = os.fork()
    except OSError as error:
        os.write(report, f"{error}\n".encode())
        os._exit(1)
    if pid:
        for stream in streams:
            os.close(stream)
        os.write(report, f"{pid}\n".encode())
        status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        os.write(report, f"{status}\n".encode())
        os._exit(0)
    os.setsid()
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
    for descriptor in (*streams, report):
        os.close(descriptor)
    if order["clock"]:
        follow(order["clock"])
    give_up_privileges(order["limits"], seccomp_filter)
    guard.after_in_child()
    return order

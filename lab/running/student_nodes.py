"""Runs a student's file as a node, in a process of its own and in the robot's namespace."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from lab.client.connection import NAMESPACE, connection
from lab.client.interaction_log import log
from lab.client.waiting import becomes_true
from lab.errors import LabError, NodeEndedError
from lab.running.node_diagnosis import how_it_ended, own_output, what_is_missing
from lab.running.processes import Process, ProcessHistory
from ros_runtime.cell_notice import notice
from ros_runtime.notebook_domains import expect_node, forget_node
from ros_runtime.reachability import UNKNOWN_NODE, wait_until_reachable

START_TIMEOUT = 10.0  # s

_nodes: dict[Path, StudentNode] = {}


def run_node(file: str | Path, *arguments: str) -> StudentNode:
    """Start a Python file as a process in namespace /robot and wait until its node can be reached.

    If a node that was started earlier from the same file still runs, it is stopped first, so that no old server
    responds. `arguments` are passed to the program. What is still to be written in it is printed.

    Raises:
        LabError: there is no such file.
        NodeEndedError: the program ended with an error at once; the message quotes its output.
    """
    path = existing_file(file)
    log.clear()  # pending requests to an earlier server are not part of the next interaction
    earlier = _nodes.pop(path, None)
    if earlier is not None:
        earlier.stop()
    known, appeared = _nodes_seen(), {}
    node = StudentNode(path, Process([str(path), *in_namespace(arguments)]))
    _nodes[path] = node

    def has_appeared() -> bool:
        appeared.update({gid: name for gid, name in _nodes_seen().items() if gid not in known})
        return bool(appeared) or not node.is_running

    with notice(
        f"{path.name} is starting. Its node can be reached in a few seconds, on a busy machine in up to 20 s."
    ):
        if missing := what_is_missing([path]):
            print(missing.strip())
        if becomes_true(has_appeared, START_TIMEOUT):
            deadline = time.monotonic() + START_TIMEOUT
            for name in appeared.values():
                wait_until_reachable(
                    connection().node, name, lambda: not node.is_running or time.monotonic() > deadline
                )
                node.expect(name)
    if not node.is_running and node.exit_status != 0:
        raise NodeEndedError(
            f"{path.name} ended at once {how_it_ended(node)}\nIt printed:\n{own_output(node)}"
        )
    return node


def stop_nodes() -> None:
    """Stop every node that `run_node` started."""
    for node in _nodes.values():
        node.stop()
    _nodes.clear()


def existing_file(file: str | Path) -> Path:
    """Return the absolute path of a student's file.

    Raises LabError when there is no such file.
    """
    path = Path(file).resolve()
    if not path.is_file():
        raise LabError(
            f"there is no file {file} in {Path.cwd()}; run the cell that begins %%writefile {file}"
        )
    return path


def in_namespace(arguments: Sequence[str]) -> list[str]:
    """Return a program's arguments, followed by the ROS arguments that put its node into the robot's namespace."""
    return [*arguments, "--ros-args", "-r", f"__ns:={NAMESPACE}"]


def started_nodes() -> list[StudentNode]:
    """Return the last node of each file that `run_node` started, in the order of their start."""
    return list(_nodes.values())


class StudentNode:
    """A student's file that runs, or has run, as a node in a process of its own.

    Attributes:
        file: its path.
        process: its process.
        was_stopped: whether the notebook ended it with `stop()` or `kill()`.
        names: the full names of its ROS nodes that were discovered at its start.
    """

    def __init__(self, file: Path, process: Process) -> None:
        self.file = file
        self.process = process
        self.was_stopped = False
        self.names: list[str] = []
        self._expected: list[str] = []

    def expect(self, name: str) -> None:
        """Make the ros2 commands in cells wait for this process's node, until the process is stopped."""
        self.names.append(name)
        self._expected.append(name)
        expect_node(name)

    @property
    def is_running(self) -> bool:
        """Whether the node's process is still running."""
        return self.process.is_running

    @property
    def exit_status(self) -> int | None:
        """None while the process runs, 0 after a clean end, -n if signal n ended it."""
        return self.process.exit_status

    def log(self) -> str:
        """Return everything that the node has printed: the output of `print()`, log messages and tracebacks."""
        return self.process.output()

    def history(self) -> ProcessHistory:
        """Return when the node began and ended, and its printed lines with their times, for a picture."""
        return ProcessHistory.of(self.file.name, self.process, was_stopped=self.was_stopped)

    def stop(self) -> None:
        """Send SIGINT, as Ctrl-C does. If the node does not end within 3 s, kill it and print that."""
        self._expect_no_more()
        if self.is_running:
            self.was_stopped = True
            if not self.process.stop():
                print(f"{self.file.name} did not end within 3 s of Ctrl-C and was killed")

    def kill(self) -> None:
        """End the node like a crash or a power cut: it cannot clean up or announce its end to other nodes."""
        self.was_stopped = True
        self._expect_no_more()
        self.process.kill()

    def _expect_no_more(self) -> None:
        while self._expected:
            forget_node(self._expected.pop())

    def __repr__(self) -> str:
        state = "running" if self.is_running else f"ended with exit status {self.exit_status}"
        return f"<{self.file.name}: {state}>"


def _nodes_seen() -> dict[bytes, str]:
    """Return the full names of the nodes in the graph, by the unique GID of each node's /rosout publisher."""
    return {
        bytes(info.endpoint_gid): f"{info.node_namespace.rstrip('/')}/{info.node_name}"
        for info in connection().node.get_publishers_info_by_topic("/rosout")
        if info.node_name != UNKNOWN_NODE
    }

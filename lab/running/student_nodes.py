"""Runs a student's file as a node, in a process of its own and in the robot's namespace."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from autograder.authoring.diagnosis.exit_diagnosis import remedy_for_a_traceback
from lab.client.connection import NAMESPACE, connection
from lab.client.interaction_log import log
from lab.client.waiting import becomes_true
from lab.errors import LabError, NodeEndedError
from lab.notices import notice
from lab.running.processes import Process, ProcessHistory
from ros_runtime.notebook_domains import expect_node, forget_node
from ros_runtime.reachability import wait_until_reachable

START_TIMEOUT = 10.0  # s
NOT_YET_KNOWN = "_NODE_NAME_UNKNOWN_"  # rmw's name for a node that it has discovered but not identified yet

_nodes: dict[Path, StudentNode] = {}


def run_node(file: str | Path, *arguments: str) -> StudentNode:
    """Start a Python file as a process in namespace /robot and wait until its node can be reached.

    If a node that was started earlier from the same file still runs, it is stopped first, so that no old server
    responds. `arguments` are passed to the program.

    Raises:
        LabError: there is no such file.
        NodeEndedError: the program ended with an error at once; the message quotes its output.
    """
    path = existing_file(file)
    log.clear()  # pending requests to an earlier server are not part of the next interaction
    earlier = _nodes.pop(path, None)
    if earlier is not None:
        earlier.stop()
    known = _nodes_seen()
    node = StudentNode(path, Process([str(path), *in_namespace(arguments)]))
    _nodes[path] = node
    with notice(
        f"{path.name} is starting. Its node can be reached in a few seconds, on a busy machine in up to 20 s."
    ):
        if becomes_true(lambda: not node.is_running or _nodes_seen().keys() - known, START_TIMEOUT):
            deadline = time.monotonic() + START_TIMEOUT
            for gid, name in _nodes_seen().items():
                if gid not in known:
                    wait_until_reachable(
                        connection().node, name, lambda: not node.is_running or time.monotonic() > deadline
                    )
                    node.expect(name)
    if not node.is_running and node.exit_status != 0:
        raise NodeEndedError(
            f"{path.name} ended at once with exit status {node.exit_status}. {_advice_and_output(node)}"
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


def output_of_failed_nodes() -> str:
    """Return the output of each node that ended with an error, to quote in an error message; "" if there is none."""
    return "".join(
        f"\n{node.file.name} has ended with exit status {node.exit_status}. {_advice_and_output(node)}"
        for node in _nodes.values()
        if node.exit_status and not node.was_stopped
    )


class StudentNode:
    """A student's file that runs, or has run, as a node in a process of its own.

    Attributes:
        file: its path.
        was_stopped: whether the notebook ended it with `stop()` or `kill()`.
    """

    def __init__(self, file: Path, process: Process) -> None:
        self.file = file
        self.was_stopped = False
        self._process = process
        self._expected: list[str] = []

    def expect(self, name: str) -> None:
        """Make the ros2 commands in cells wait for this process's node, until the process is stopped."""
        self._expected.append(name)
        expect_node(name)

    @property
    def is_running(self) -> bool:
        """Whether the node's process is still running."""
        return self._process.is_running

    @property
    def exit_status(self) -> int | None:
        """None while the process runs, 0 after a clean end, -n if signal n ended it."""
        return self._process.exit_status

    def log(self) -> str:
        """Return everything that the node has printed: the output of `print()`, log messages and tracebacks."""
        return self._process.output()

    def history(self) -> ProcessHistory:
        """Return when the node began and ended, and its printed lines with their times, for a picture."""
        return ProcessHistory.of(self.file.name, self._process, was_stopped=self.was_stopped)

    def stop(self) -> None:
        """Send SIGINT, as Ctrl-C does. If the node does not end within 3 s, kill it and print that."""
        self._expect_no_more()
        if self.is_running:
            self.was_stopped = True
            if not self._process.stop():
                print(f"{self.file.name} did not end within 3 s of Ctrl-C and was killed")

    def kill(self) -> None:
        """End the node like a crash or a power cut: it cannot clean up or announce its end to other nodes."""
        self.was_stopped = True
        self._expect_no_more()
        self._process.kill()

    def _expect_no_more(self) -> None:
        while self._expected:
            forget_node(self._expected.pop())

    def __repr__(self) -> str:
        state = "running" if self.is_running else f"ended with exit status {self.exit_status}"
        return f"<{self.file.name}: {state}>"


def _advice_and_output(node: StudentNode) -> str:
    """Return the self-check's advice on the node's last exception, followed by all that the node printed."""
    remedy = remedy_for_a_traceback(node.log())
    advice = remedy.help.replace("{of}", "") + " " if remedy else ""
    return f"{advice}It printed:\n{node.log()}"


def _nodes_seen() -> dict[bytes, str]:
    """Return the full names of the nodes in the graph, by the unique GID of each node's /rosout publisher."""
    return {
        bytes(info.endpoint_gid): f"{info.node_namespace.rstrip('/')}/{info.node_name}"
        for info in connection().node.get_publishers_info_by_topic("/rosout")
        if info.node_name != NOT_YET_KNOWN
    }

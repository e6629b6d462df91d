"""Waiting for several nodes at once: a node that never answers does not delay the others."""

from __future__ import annotations

from itertools import count
from typing import Any

import pytest

pytest.importorskip("rclpy")

from rclpy.task import Future

from ros_runtime.reachability import wait_until_all_reachable, wait_until_reachable


class FakeClient:
    """A client of a node that answers from the `patience`-th request on; None: never."""

    def __init__(self, patience: int | None) -> None:
        self._patience = patience
        self.asked = 0
        self.removed = 0

    def service_is_ready(self) -> bool:
        return True

    def call_async(self, _: Any) -> Future:
        self.asked += 1
        future = Future()
        if self._patience is not None and self.asked >= self._patience:
            future.set_result("an answer")
        return future

    def remove_pending_request(self, _: Future) -> None:
        self.removed += 1


class FakeNode:
    """Knows nodes by name."""

    def __init__(self, **patience: int | None) -> None:
        self.clients = {f"/{name}/list_parameters": FakeClient(value) for name, value in patience.items()}
        self.destroyed = 0

    def create_client(self, _: Any, name: str) -> FakeClient:
        return self.clients[name]

    def destroy_client(self, _: FakeClient) -> None:
        self.destroyed += 1


def after(rounds: int) -> Any:
    looks = count(1)
    return lambda: next(looks) > rounds


def test_answering_nodes_are_returned_and_a_silent_one_is_requested_until_the_end() -> None:
    node = FakeNode(quick=1, slow=2, dead=None)
    reachable = wait_until_all_reachable(node, ["/quick", "/slow", "/dead"], after(3))  # type: ignore[arg-type]
    assert reachable == {"/quick", "/slow"}
    assert [client.asked for client in node.clients.values()] == [1, 2, 3]
    assert node.clients["/dead/list_parameters"].removed == 3
    assert node.destroyed == 3


def test_without_nodes_none_is_reachable() -> None:
    assert wait_until_all_reachable(FakeNode(), [], after(3)) == set()  # type: ignore[arg-type]


def test_one_node_is_waited_for_in_the_same_way() -> None:
    assert wait_until_reachable(FakeNode(a=1), "/a", after(3))  # type: ignore[arg-type]
    assert not wait_until_reachable(FakeNode(a=None), "/a", after(2))  # type: ignore[arg-type]

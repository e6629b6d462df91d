"""The ROS graph, to which any participant can write: names, types and numbers of endpoints."""

from __future__ import annotations

from typing import Any, NamedTuple

from hypothesis import strategies as st

from autograder.arena import events as ev
from autograder.arena.graph import MOST_SERVICES, MOST_TOPICS, Graph
from autograder.engine.arena_run import read_events
from fuzz import strategies as odd
from fuzz.fuzzer import Fuzzer

MANY = 3000


class Endpoint(NamedTuple):
    """An endpoint as the middleware describes it."""

    node_name: Any
    node_namespace: Any
    topic_type: Any


class WildNode:
    """Answers each query of the graph with the value drawn for it; raises it if it is an exception."""

    def __init__(self, answers: dict[str, Any]) -> None:
        self._answers = answers

    def resolve_service_name(self, name: str) -> str:
        """Return the full name."""
        return f"/robot/{name}"

    def get_namespace(self) -> str:
        """Return the robot's."""
        return "/robot"

    def __getattr__(self, question: str) -> Any:
        def answer(*_: Any, **__: Any) -> Any:
            found = self._answers.get(question, 0 if question.startswith("count") else [])
            if isinstance(found, Exception):
                raise found
            return found

        return answer


def require_record_of_a_graph(answers: dict[str, Any]) -> None:
    """Require that each question has an answer, and that what is recorded is bounded and can be read."""
    with odd.recorded() as (log, lines):
        graph = Graph(WildNode(answers), log)  # type: ignore[arg-type]
        graph.has_another_node()
        graph.count_matchable_subscribers("odom")
        assert all(isinstance(owner, str) for owner in graph.owners_of("get_status"))
        assert len(graph.offered()) <= MOST_SERVICES + 1
        graph.report_topics({"/robot/cmd_vel": 1})
        graph.inspect()
        topics = log.last(ev.NodeTopics)
        assert topics is not None
        assert len(topics.publishes) <= MOST_TOPICS
        assert len(topics.subscribes) <= MOST_TOPICS
        for flooded in log.all(ev.GraphFlooded):
            assert 0 < len(flooded.reason) < 400
        read_events(lines())


_no_text = UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte")
_broken = st.sampled_from((_no_text, RuntimeError("x" * 10_000), MemoryError()))
_names = st.one_of(
    odd.texts, st.sampled_from(("walk_server", "/robot", "/", "2nd", "no/name", "_NODE_NAME_UNKNOWN_"))
)
_counts = st.one_of(st.integers(0, 3), st.integers(0, 2**31), _broken)
_types = st.lists(st.one_of(odd.texts, st.just("std_srvs/srv/Trigger")), max_size=3)


def _many(of: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    few = st.lists(of, max_size=4)
    return st.one_of(few, st.lists(of, min_size=1, max_size=3).map(lambda some: some * MANY), _broken)


_endpoints = _many(
    st.builds(Endpoint, _names, _names, st.one_of(odd.texts, st.just("a::srv::dds_::B_Request_")))
)
_graphs = st.fixed_dictionaries(
    {},
    optional={
        **{f"count_{kind}": _counts for kind in ("publishers", "subscribers", "services", "clients")},
        "get_node_names_and_namespaces": _many(st.tuples(_names, _names)),
        "get_service_names_and_types": _many(st.tuples(_names, _types)),
        "get_topic_names_and_types": _many(st.tuples(_names, _types)),
        "get_subscriptions_info_by_topic": _endpoints,
        "get_publishers_info_by_topic": _broken,
    },
)

FUZZERS = (Fuzzer("graph", "graph", _graphs, require_record_of_a_graph, weight=0.5),)

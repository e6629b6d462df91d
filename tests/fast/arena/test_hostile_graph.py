"""Whatever the ROS graph contains, every query returns a result, and unusual entries are recorded."""

from __future__ import annotations

from typing import Any, NamedTuple

import pytest

pytest.importorskip("rclpy")

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.graph import MOST_ENDPOINTS, MOST_NODES, MOST_SERVICES, Graph
from fuzz.readers.graph import WildNode


class Endpoint(NamedTuple):
    node_name: str
    node_namespace: str = "/robot"


def graph_of(log: ArenaLog, **answers: Any) -> Graph:
    return Graph(WildNode(answers), log)  # type: ignore[arg-type]


BROKEN = UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte")


def test_a_graph_that_cannot_be_read_is_empty_and_recorded_once(log: ArenaLog) -> None:
    graph = graph_of(
        log,
        count_publishers=BROKEN,
        count_subscribers=BROKEN,
        count_services=BROKEN,
        get_service_names_and_types=BROKEN,
        get_subscriptions_info_by_topic=BROKEN,
        get_node_names_and_namespaces=BROKEN,
    )
    assert not graph.has_another_node()
    assert graph.count_matchable_subscribers("odom") == 0
    assert graph.owners_of("get_status") == []
    assert graph.offered() == []
    graph.inspect()
    graph.inspect()
    reasons = [event.reason for event in log.all(ev.GraphFlooded)]
    assert "UnicodeDecodeError" in reasons[0]
    assert len(reasons) == 2  # the retry failed, too
    assert len(reasons[0]) < 300


def test_an_ordinary_graph_is_not_recorded(log: ArenaLog) -> None:
    graph = graph_of(log, get_node_names_and_namespaces=[("observer", "/robot"), ("walk_server", "/robot")])
    graph.inspect()
    assert log.all(ev.GraphFlooded) == []


@pytest.mark.parametrize("name", ["no/name", "", "2nd", "a" * 300])
def test_an_invalid_name_is_recorded(log: ArenaLog, name: str) -> None:
    graph = graph_of(log, get_node_names_and_namespaces=[(name, "/robot")])
    graph.inspect()
    (event,) = log.all(ev.GraphFlooded)
    assert event.nodes == 1
    assert repr(name[:60]) in event.reason


def test_a_crowd_of_nodes_is_counted(log: ArenaLog) -> None:
    crowd = [(f"node_{number}", "/robot") for number in range(MOST_NODES + 30_000)]
    graph = graph_of(log, get_node_names_and_namespaces=crowd)
    graph.inspect()
    assert log.all(ev.GraphFlooded)[0].reason == "there were 30,050 nodes"


def test_the_owner_of_a_service_is_found_without_a_list_of_nodes(log: ArenaLog) -> None:
    servers = [Endpoint("walk_server"), Endpoint("walk_server"), Endpoint("root", "/")]
    graph = graph_of(log, get_subscriptions_info_by_topic=servers, get_node_names_and_namespaces=BROKEN)
    assert graph.owners_of("get_status") == ["/robot/walk_server", "/root"]


def test_an_owner_without_a_name_is_left_out(log: ArenaLog) -> None:
    servers = [Endpoint("_NODE_NAME_UNKNOWN_", "_NODE_NAMESPACE_UNKNOWN_"), Endpoint("no/name")]
    graph = graph_of(log, get_subscriptions_info_by_topic=servers)
    assert graph.owners_of("get_status") == []


def test_thousands_of_servers_of_one_name_are_not_listed(log: ArenaLog) -> None:
    graph = graph_of(log, count_services=MOST_ENDPOINTS + 1, get_subscriptions_info_by_topic=[Endpoint("a")])
    assert graph.owners_of("get_status") == []


def test_some_of_thousands_of_services_are_listed_and_the_rest_counted(log: ArenaLog) -> None:
    services = [(f"/robot/service_{number:04}", ["std_srvs/srv/Trigger"]) for number in range(3000)]
    graph = graph_of(log, get_service_names_and_types=services, count_services=1)
    *offered, more = graph.offered()
    assert len(offered) == MOST_SERVICES
    assert offered[0] == "/robot/service_0000 [std_srvs/srv/Trigger]"
    assert more == "and up to 2,960 more"


def test_services_of_the_robot_of_every_node_and_without_a_server_are_not_listed(log: ArenaLog) -> None:
    arm_ik = ("/robot/compute_arm_ik", ["humanoid_interfaces/srv/ComputeArmIK"])
    assert graph_of(log, get_service_names_and_types=[arm_ik], count_services=1).offered() == []
    parameters = ("/robot/a/get_parameters", ["rcl_interfaces/srv/GetParameters"])
    wanted = ("/robot/get_status", ["std_srvs/srv/Trigger"])
    assert graph_of(log, get_service_names_and_types=[parameters], count_services=1).offered() == []
    assert graph_of(log, get_service_names_and_types=[wanted], count_services=0).offered() == []


def test_the_topics_of_a_students_node_are_distinguished_from_the_robots(log: ArenaLog) -> None:
    names = (
        "/robot/odom",
        "/robot/imu",
        "/robot/cmd_vel",
        "/motor_power",
        "/rosout",
        "/robot/walk/_action/feedback",
    )
    graph = graph_of(
        log,
        get_namespace="/robot",
        get_topic_names_and_types=[(name, ["std_msgs/msg/Empty"]) for name in names],
        count_publishers=1,
        count_subscribers=1,
    )
    graph.report_topics({"/robot/cmd_vel": 1})
    found = log.last(ev.NodeTopics)
    assert found is not None
    assert found.publishes == ["/robot/cmd_vel", "/motor_power"]
    assert found.subscribes == ["/robot/odom", "/robot/imu", "/motor_power"]


class Server(NamedTuple):
    """A server as the graph describes it."""

    topic_type: str


@pytest.mark.parametrize(
    ("mangled", "told"),
    [
        ("std_srvs::srv::dds_::Trigger_Request_", "/robot/get_status [std_srvs/srv/Trigger]"),
        ("nonsense", "/robot/get_status [std_srvs/srv/SetBool]"),
    ],
)
def test_a_service_has_the_type_of_its_server_not_of_the_graders_client(
    log: ArenaLog, mangled: str, told: str
) -> None:
    types = ["std_srvs/srv/SetBool", "std_srvs/srv/Trigger"]
    graph = graph_of(
        log,
        get_service_names_and_types=[("/robot/get_status", types)],
        count_services=1,
        get_subscriptions_info_by_topic=[Server(mangled)],
    )
    assert graph.offered() == [told]

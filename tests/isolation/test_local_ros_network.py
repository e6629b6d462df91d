"""Arenas that share the host's network stay out of each other's way."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

import pytest

from autograder.isolation.local_ros_network import NoDomainLeftError, reserve_domain


def test_two_arenas_have_different_domains_whose_ports_no_client_is_given(tmp_path: Path) -> None:
    with reserve_domain(tmp_path) as one, reserve_domain(tmp_path) as other:
        domains = {int(one["ROS_DOMAIN_ID"]), int(other["ROS_DOMAIN_ID"])}
    assert len(domains) == 2
    assert all(1 <= domain <= 101 or 215 <= domain <= 232 for domain in domains)


def test_when_all_are_taken_it_says_so_and_a_freed_one_is_used_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with ExitStack() as all_domains:
        taken = [all_domains.enter_context(reserve_domain(tmp_path)) for _ in range(118)]
        last = all_domains.enter_context(ExitStack())
        freed = last.enter_context(reserve_domain(tmp_path))["ROS_DOMAIN_ID"]
        assert len({env["ROS_DOMAIN_ID"] for env in taken} | {freed}) == 119
        with pytest.raises(NoDomainLeftError, match="all 119 ROS domain ids are in use"):
            all_domains.enter_context(reserve_domain(tmp_path))
        last.close()
        with reserve_domain(tmp_path) as env:
            assert env["ROS_DOMAIN_ID"] == freed


def test_the_transport_is_limited_to_this_machine(tmp_path: Path) -> None:
    with reserve_domain(tmp_path) as env:
        assert "<address>127.0.0.1</address>" in Path(env["FASTRTPS_DEFAULT_PROFILES_FILE"]).read_text()

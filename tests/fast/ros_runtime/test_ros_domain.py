"""ROS systems on one machine use different domains."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros_runtime.ros_domain import DOMAIN_IDS, NoDomainLeft, ReservedDomain, loopback_variables


@pytest.fixture(autouse=True)
def locks_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))


def test_each_domain_is_reserved_once_and_outside_the_ephemeral_ports() -> None:
    domains = [ReservedDomain() for _ in DOMAIN_IDS]
    assert sorted(domain.domain_id for domain in domains) == [*range(1, 102), *range(215, 233)]
    for domain in domains:
        domain.release()


def test_if_all_domains_are_taken_it_raises_and_a_released_one_is_reused() -> None:
    *others, last = [ReservedDomain() for _ in DOMAIN_IDS]
    with pytest.raises(NoDomainLeft, match="all 119 ROS domains are in use"):
        ReservedDomain()
    last.release()
    again = ReservedDomain()
    assert again.domain_id == last.domain_id
    for domain in (*others, again):
        domain.release()


def test_the_transport_is_limited_to_this_machine() -> None:
    profile = loopback_variables()["FASTRTPS_DEFAULT_PROFILES_FILE"]
    assert "<address>127.0.0.1</address>" in Path(profile).read_text()

"""The fastest growth of a total over a stretch of time, whenever it is looked at."""

import pytest

from autograder.arena.fastest_growth import FastestGrowth


def fastest(looks, stretch):
    growth = FastestGrowth()
    for now, total in looks:
        growth.look(now, total, stretch)
    return growth.rate


def test_a_burst_is_seen_among_slow_growth():
    slow = [(0.25 * n, 0.01 * n) for n in range(9)]
    burst = [(2.25, 0.2), (2.5, 0.4), (2.75, 0.41)]
    assert fastest([*slow, *burst], stretch=0.5) == pytest.approx((0.4 - 0.08) / 0.5)


def test_a_little_all_the_time_stays_little_however_long_it_lasts():
    assert fastest([(0.1 * n, 0.005 * n) for n in range(1000)], stretch=1.0) == pytest.approx(0.05)


def test_growth_that_is_younger_than_the_stretch_counts_as_if_it_had_taken_so_long():
    assert fastest([(0.0, 0.0), (0.1, 0.1)], stretch=1.0) == pytest.approx(0.1)


def test_looks_that_come_seldom_give_the_mean_between_them():
    assert fastest([(0.0, 0.0), (4.0, 2.0)], stretch=1.0) == pytest.approx(0.5)


def test_nothing_is_known_at_the_first_look():
    assert fastest([(7.0, 3.0)], stretch=1.0) == 0.0

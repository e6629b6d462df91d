"""The highest growth rate of a total, and the processor time that a program lost to others, at any sampling."""

import pytest

from autograder.arena.student_limits_monitor import FastestGrowth, MissedTime


def fastest(looks, stretch):
    growth = FastestGrowth()
    for now, total in looks:
        growth.look(now, total, stretch)
    return growth.rate


def test_a_burst_is_seen_among_slow_growth():
    slow = [(0.25 * n, 0.01 * n) for n in range(9)]
    burst = [(2.25, 0.2), (2.5, 0.4), (2.75, 0.41)]
    assert fastest([*slow, *burst], stretch=0.5) == pytest.approx((0.4 - 0.08) / 0.5)


def test_slow_growth_stays_slow_however_long_it_lasts():
    assert fastest([(0.1 * n, 0.005 * n) for n in range(1000)], stretch=1.0) == pytest.approx(0.05)


def test_growth_younger_than_the_window_is_averaged_over_the_whole_window():
    assert fastest([(0.0, 0.0), (0.1, 0.1)], stretch=1.0) == pytest.approx(0.1)


def test_rare_samples_give_the_mean_rate_between_them():
    assert fastest([(0.0, 0.0), (4.0, 2.0)], stretch=1.0) == pytest.approx(0.5)


def test_the_first_sample_gives_no_rate():
    assert fastest([(7.0, 3.0)], stretch=1.0) == 0.0


def lost(*looks):
    time = MissedTime()
    for look in looks:
        time.look(*look)
    return time.total


def test_time_in_which_a_program_waits_for_a_processor_counts_as_lost():
    assert lost((0.0, 0.0, 0.0), (1.0, 0.2, 0.7), (2.0, 0.9, 0.8)) == pytest.approx(0.8)


def test_twelve_busy_processes_that_share_a_processor_lose_nothing():
    assert lost((0.0, 0.0, 0.0), (1.0, 1.0, 11.0), (2.0, 2.9, 21.0)) == 0.0


def test_lost_time_never_exceeds_the_elapsed_time():
    assert lost((0.0, 0.0, 0.0), (1.0, 0.1, 5.0)) == pytest.approx(0.9)


def test_waiting_before_the_first_sample_does_not_count():
    assert lost((5.0, 1.0, 3.0)) == 0.0

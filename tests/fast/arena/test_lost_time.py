"""What a program lost to other programs, and what its own processes took from each other."""

import pytest

from autograder.arena.lost_time import LostTime


def lost(*looks):
    time = LostTime()
    for look in looks:
        time.look(*look)
    return time.total


def test_what_a_program_waits_for_while_others_run_is_lost():
    assert lost((0.0, 0.0, 0.0), (1.0, 0.2, 0.7), (2.0, 0.9, 0.8)) == pytest.approx(0.8)


def test_twelve_busy_processes_that_share_a_processor_lose_nothing():
    assert lost((0.0, 0.0, 0.0), (1.0, 1.0, 11.0), (2.0, 2.9, 21.0)) == 0.0


def test_no_more_is_lost_than_the_time_that_passed():
    assert lost((0.0, 0.0, 0.0), (1.0, 0.1, 5.0)) == pytest.approx(0.9)


def test_what_was_waited_for_before_the_first_look_does_not_count():
    assert lost((5.0, 1.0, 3.0)) == 0.0

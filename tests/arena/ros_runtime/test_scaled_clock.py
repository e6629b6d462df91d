"""Processes that follow a scaled clock, timed from outside in real time."""

import json
import os
import shutil
import subprocess
import sys
import time

import pytest
from waits import KERNEL_TIMERS, WAITS

from ros_runtime.environment import ros_environment
from ros_runtime.workarounds.scaled_clock.clock import ScaledClock, follow

# Reads both clocks of the process repeatedly, and the real time before and after each reading.
READ_CLOCKS = """
import ctypes, json, sys, time
real = ctypes.CDLL(None).scaled_clock_real_monotonic_ns
real.restype = ctypes.c_int64
print("begin", flush=True)
samples, end = [], real() + int(float(sys.argv[1]) * 1e9)
while real() < end:
    samples.append((real(), time.monotonic_ns(), time.time_ns(), real()))
print(json.dumps(samples[:: max(1, len(samples) // 3000)]))
"""


def scaled_ns(clock, real_ns):
    """The time that a process on the scaled clock reads at a time of the real CLOCK_MONOTONIC."""
    return real_ns + int(max(0, real_ns - clock.switch_ns) * (clock.scale - 1))


def following(clock):
    return os.environ | clock.environment()


def time_wait(process):
    """The duration of the wait (s): an upper bound in real time, and as the process measured it."""
    begin = time.monotonic()
    inside = float(process.stdout.readline())
    return time.monotonic() - begin, inside


@pytest.mark.parametrize("wait", [*WAITS, *KERNEL_TIMERS])
def test_every_way_to_wait_follows_the_clock(clock, start, wait):
    clock.run_at(10.0)
    process = start("-S", "waits.py", wait, 2, environment=following(clock))
    assert process.stdout.readline() == "begin\n"
    outside, inside = time_wait(process)
    assert 2.0 <= inside < 9.0
    assert outside < 1.0  # 0.2 s when the machine is idle, 2 s if the wait were not scaled


@pytest.mark.parametrize("wait", WAITS)
def test_a_wait_begun_before_the_switch_ends_in_time(clock, start, wait):
    process = start("-S", "waits.py", wait, 3, environment=following(clock))
    assert process.stdout.readline() == "begin\n"
    begin = time.monotonic()
    clock.run_at(10.0)
    inside = float(process.stdout.readline())
    assert time.monotonic() - begin < 1.5  # 0.3 s when the machine is idle, 3 s if nothing woke it
    assert 3.0 <= inside < 15.0


# Twenty ticks of a ROS timer and twenty turns of a Rate, on an executor each kind of student node uses.
ROS_WAITS = """
import sys, threading, time, rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
rclpy.init()
node = rclpy.create_node("node")
executor = {"single": SingleThreadedExecutor, "multi": lambda: MultiThreadedExecutor(2)}[sys.argv[1]]()
executor.add_node(node)
done, ticks = threading.Event(), []
def tick():
    ticks.append(time.monotonic())
    if len(ticks) == 20:
        done.set()
spinner = threading.Thread(target=executor.spin)
spinner.start()
print("begin", flush=True)
start = time.monotonic()
timer = node.create_timer(0.1, tick)
assert done.wait(30)
rate = node.create_rate(10)
for _ in range(20):
    rate.sleep()
print(time.monotonic() - start, flush=True)
executor.shutdown()
spinner.join()
"""


@pytest.mark.parametrize("executor", ["single", "multi"])
@pytest.mark.parametrize("switch", ["before", "during"])
def test_timers_and_rates_of_a_node_follow_the_clock(clock, start, executor, switch):
    if switch == "before":
        clock.run_at(5.0)
    environment = following(clock) | ros_environment() | {"ROS_DOMAIN_ID": str(os.getpid() % 100 + 1)}
    process = start("-c", ROS_WAITS, executor, environment=environment)
    assert process.stdout.readline() == "begin\n"
    if switch == "during":
        clock.run_at(5.0)
    outside, inside = time_wait(process)
    assert 3.8 < inside < 8.0
    assert outside < 2.0  # 0.8 s when the machine is idle, 4 s if it were not scaled


def test_a_select_without_a_timeout_ends_at_its_input(clock, start):
    code = "import select, sys; print('begin', flush=True); select.select([0], [], []); print(input())"
    process = start("-c", code, environment=following(clock))
    assert process.stdout.readline() == "begin\n"
    process.stdin.write("news\n")
    process.stdin.flush()
    assert process.stdout.readline() == "news\n"


def test_processes_agree_on_the_time_before_across_and_after_the_switch(clock, start):
    processes = [start("-c", READ_CLOCKS, 0.4, environment=following(clock)) for _ in range(2)]
    assert [process.stdout.readline() for process in processes] == ["begin\n", "begin\n"]
    clock.run_at(5.0)
    for process in processes:
        samples = json.loads(process.stdout.readline())
        before, monotonic, realtime, after = zip(*samples, strict=True)
        assert clock.switch_ns in range(before[0], after[-1]), "the switch was not seen"
        assert list(monotonic) == sorted(monotonic)
        assert list(realtime) == sorted(realtime)
        assert all(
            scaled_ns(clock, first) <= seen <= scaled_ns(clock, last)
            for first, seen, last in zip(before, monotonic, after, strict=True)
        )


def test_the_wall_clock_time_is_right_until_the_switch(clock, start):
    process = start("-c", "import time; print(time.time())", environment=following(clock))
    assert float(process.stdout.readline()) == pytest.approx(time.time(), abs=2.0)


def test_a_forked_child_follows_the_same_clock(clock, start):
    code = (
        "import os, sys, time; child = os.fork(); start = time.monotonic(); time.sleep(2);"
        "print(time.monotonic() - start, flush=True) if child == 0 else os.waitpid(child, 0)"
    )
    clock.run_at(5.0)
    process = start("-c", code, environment=following(clock))
    outside, inside = time_wait(process)
    assert inside >= 2.0
    assert outside < 1.5


def test_a_fork_of_a_process_without_a_clock_can_follow_one(clock, clock_library, start):
    code = """
import os, sys, time
from ros_runtime.workarounds.scaled_clock.clock import follow, real_monotonic_ns
if os.fork() == 0:
    follow(sys.argv[1])
    began, inside = real_monotonic_ns(), time.monotonic()
    time.sleep(2)
    print(time.monotonic() - inside, (real_monotonic_ns() - began) * 1e-9, flush=True)
    os._exit(0)
os.wait()
print(abs(time.monotonic_ns() - real_monotonic_ns()) < 1e9, flush=True)
"""
    clock.run_at(10.0)
    process = start("-c", code, clock.path, environment=os.environ | {"LD_PRELOAD": str(clock_library)})
    inside, outside = map(float, process.stdout.readline().split())
    assert 2.0 <= inside < 9.0
    assert 0.15 < outside < 1.0
    assert process.stdout.readline() == "True\n"


def test_without_the_library_no_clock_can_be_followed(clock):
    with pytest.raises(OSError, match="not preloaded"):
        follow(clock.path)


def test_a_signal_to_a_condition_variable_is_not_lost_while_the_clock_may_change(clock, start):
    """The waiter sleeps in pieces; the signals come at all times relative to them."""
    code = """
import ctypes, threading, time
from waits import libc, after
condition, mutex = ctypes.create_string_buffer(64), ctypes.create_string_buffer(64)
flag, latencies = False, []
def signal_later(delay):
    global flag, sent
    time.sleep(delay)
    libc.pthread_mutex_lock(mutex)
    flag, sent = True, time.monotonic()
    libc.pthread_cond_signal(condition)
    libc.pthread_mutex_unlock(mutex)
for i in range(40):
    flag = False
    threading.Thread(target=signal_later, args=[0.001 * i]).start()
    deadline = after(30)
    libc.pthread_mutex_lock(mutex)
    while not flag:
        libc.pthread_cond_timedwait(condition, mutex, deadline)
    latencies.append(time.monotonic() - sent)
    libc.pthread_mutex_unlock(mutex)
print(max(latencies))
"""
    process = start("-c", code, environment=following(clock))
    assert float(process.stdout.readline()) < 5.0


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (lambda page: None, "cannot read a clock page"),
        (lambda page: page.write_bytes(b"\0" * 4096), "not a clock page of version 2"),
    ],
    ids=["missing", "foreign"],
)
def test_without_a_usable_page_time_stays_as_it_is_and_the_library_says_so(
    tmp_path, clock_library, change, complaint
):
    page = tmp_path / "page"
    change(page)
    environment = os.environ | {"LD_PRELOAD": str(clock_library), "SCALED_CLOCK_PAGE": str(page)}
    done = subprocess.run(
        [sys.executable, "-c", "import time; print(time.monotonic())"],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert complaint in done.stderr
    assert float(done.stdout) == pytest.approx(time.monotonic(), abs=5.0)


def test_without_the_variable_the_library_does_nothing(clock_library, start):
    environment = {name: value for name, value in os.environ.items() if name != "SCALED_CLOCK_PAGE"}
    process = start(
        "waits.py", "time.sleep", 0.3, environment=environment | {"LD_PRELOAD": str(clock_library)}
    )
    assert process.stdout.readline() == "begin\n"
    outside, inside = time_wait(process)
    assert outside >= 0.25
    assert inside == pytest.approx(outside, abs=0.1)


@pytest.mark.skipif(not shutil.which("bwrap"), reason="needs bubblewrap")
def test_a_sandboxed_process_follows_a_page_it_cannot_write(clock, start):
    clock.run_at(5.0)
    sandbox = ["bwrap", "--dev-bind", "/", "/", "--ro-bind", str(clock.path), str(clock.path)]
    code = (
        "import sys, time; start = time.monotonic(); time.sleep(2); print(time.monotonic() - start)\n"
        "try: open(sys.argv[1], 'r+b')\n"
        "except OSError: print('read-only')"
    )
    begin = time.monotonic()
    done = subprocess.run(
        [*sandbox, sys.executable, "-c", code, str(clock.path)],
        env=following(clock),
        capture_output=True,
        text=True,
        check=True,
    )
    assert time.monotonic() - begin < 1.5
    inside, access = done.stdout.split()
    assert float(inside) >= 2.0
    assert access == "read-only"


def test_a_process_can_switch_the_clock_that_it_follows(tmp_path, clock_library, start):
    code = """
import sys, time
from pathlib import Path
from ros_runtime.workarounds.scaled_clock.clock import ScaledClock, follow, real_monotonic_ns
clock = ScaledClock.create(sys.argv[1], library=Path(sys.argv[2]))
follow(clock.path)
clock.run_at(5.0)
began, inside = real_monotonic_ns(), time.monotonic()
time.sleep(2)
print(time.monotonic() - inside, (real_monotonic_ns() - began) * 1e-9, flush=True)
"""
    page, environment = tmp_path / "own_page", os.environ | {"LD_PRELOAD": str(clock_library)}
    process = start("-c", code, page, clock_library, environment=environment)
    inside, outside = map(float, process.stdout.readline().split())
    assert 2.0 <= inside < 7.0
    assert 0.35 < outside < 1.4


def test_a_clock_is_switched_once(clock):
    clock.run_at(5.0)
    with pytest.raises(RuntimeError, match=r"stays at scale 5\.0"):
        clock.run_at(1.0)


@pytest.mark.parametrize("scale", [0.0, -1.0, 1000.0, float("nan")])
def test_an_impossible_scale_is_refused(clock, scale):
    with pytest.raises(ValueError, match=r"expected 0\.01 to 100"):
        clock.run_at(scale)


def test_where_the_library_is_missing_only_scale_1_is_possible(tmp_path, monkeypatch):
    monkeypatch.setattr("ros_runtime.workarounds.scaled_clock.clock.library_path", lambda: None)
    clock = ScaledClock.create(tmp_path / "page")
    assert clock.environment() == {}
    with pytest.raises(RuntimeError, match="C compiler"):
        clock.run_at(5.0)
    clock.run_at(1.0)
    assert clock.scale == 1.0

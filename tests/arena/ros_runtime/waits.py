"""Every way to wait for a time, to be run under the scaled clock: `python waits.py NAME SECONDS`.

Prints "begin", waits, and prints the seconds that passed on the process's own monotonic clock.
"""

import asyncio
import contextlib
import ctypes
import os
import queue
import select
import signal
import sys
import threading
import time

libc = ctypes.CDLL(None, use_errno=True)  # finds the preloaded functions first, as a C program would
libc.usleep.argtypes = [ctypes.c_uint]
CLOCK_MONOTONIC, TIMER_ABSTIME, ETIMEDOUT = 1, 1, 110


class Timespec(ctypes.Structure):
    _fields_ = (("seconds", ctypes.c_long), ("nanoseconds", ctypes.c_long))


class Itimerspec(ctypes.Structure):
    _fields_ = (("interval", Timespec), ("value", Timespec))


def timespec(seconds):
    return Timespec(int(seconds), int(seconds % 1 * 1e9))


def after(seconds, clock=time.CLOCK_REALTIME):
    return ctypes.byref(timespec(time.clock_gettime(clock) + seconds))


def get_from_queue(seconds):
    with contextlib.suppress(queue.Empty):
        queue.Queue().get(timeout=seconds)


def poll_epoll(seconds):
    with select.epoll() as epoll:
        epoll.poll(seconds)


def select_with_descriptor(seconds):
    read, _ = os.pipe()
    assert select.select([read], [], [], seconds) == ([], [], [])


def on_alarm(arm):
    signal.signal(signal.SIGALRM, lambda *_: None)
    arm()
    signal.pause()


def sigtimedwait(seconds):
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])
    assert signal.sigtimedwait([signal.SIGUSR1], seconds) is None


def wait_condition(seconds, clock, wait):
    """Loop as a C program does: after each wake-up wait again, until the deadline."""
    condition, mutex, attributes = (ctypes.create_string_buffer(64) for _ in range(3))
    libc.pthread_condattr_init(attributes)
    libc.pthread_condattr_setclock(attributes, clock)
    libc.pthread_cond_init(condition, attributes)
    deadline = after(seconds, clock)
    libc.pthread_mutex_lock(mutex)
    while wait(condition, mutex, deadline) != ETIMEDOUT:
        pass


def locked_mutex():
    mutex = ctypes.create_string_buffer(64)
    libc.pthread_mutex_lock(mutex)
    return mutex


def write_locked():
    lock = ctypes.create_string_buffer(64)
    locker = threading.Thread(target=libc.pthread_rwlock_wrlock, args=[lock])
    locker.start()
    locker.join()
    return lock


def wait_for_timerfd(flags, value):
    descriptor = libc.timerfd_create(CLOCK_MONOTONIC, 0)
    assert libc.timerfd_settime(descriptor, flags, ctypes.byref(Itimerspec(Timespec(), value)), None) == 0
    os.read(descriptor, 8)


# The kernel ends these waits, so a later switch of the clock does not affect them.
KERNEL_TIMERS = {
    "setitimer": lambda s: on_alarm(lambda: signal.setitimer(signal.ITIMER_REAL, s)),
    "alarm": lambda s: on_alarm(lambda: signal.alarm(int(s))),
    "timerfd": lambda s: wait_for_timerfd(0, timespec(s)),
    "timerfd_absolute": lambda s: wait_for_timerfd(1, timespec(time.monotonic() + s)),
}
WAITS = {
    "time.sleep": time.sleep,
    "Event.wait": lambda s: threading.Event().wait(s),
    "Queue.get": get_from_queue,
    "asyncio.sleep": lambda s: asyncio.run(asyncio.sleep(s)),
    "select": select_with_descriptor,
    "poll": lambda s: select.poll().poll(s * 1000),
    "epoll": poll_epoll,
    "sigtimedwait": sigtimedwait,
    "sleep": lambda s: libc.sleep(int(s)),
    "usleep": lambda s: libc.usleep(int(s * 1e6)),
    "nanosleep": lambda s: libc.nanosleep(ctypes.byref(timespec(s)), None),
    "clock_nanosleep": lambda s: libc.clock_nanosleep(0, TIMER_ABSTIME, after(s), None),
    "sem_timedwait": lambda s: libc.sem_timedwait(ctypes.create_string_buffer(64), after(s)),
    "pthread_mutex_timedlock": lambda s: libc.pthread_mutex_timedlock(locked_mutex(), after(s)),
    "pthread_rwlock_timedrdlock": lambda s: libc.pthread_rwlock_timedrdlock(write_locked(), after(s)),
    "pthread_rwlock_timedwrlock": lambda s: libc.pthread_rwlock_timedwrlock(write_locked(), after(s)),
    "pthread_cond_timedwait": lambda s: wait_condition(s, 0, libc.pthread_cond_timedwait),
    "pthread_cond_timedwait_monotonic": lambda s: wait_condition(
        s, CLOCK_MONOTONIC, libc.pthread_cond_timedwait
    ),
    "pthread_cond_clockwait": lambda s: wait_condition(
        s, CLOCK_MONOTONIC, lambda c, m, t: libc.pthread_cond_clockwait(c, m, CLOCK_MONOTONIC, t)
    ),
}

if __name__ == "__main__":
    wait, seconds = (WAITS | KERNEL_TIMERS)[sys.argv[1]], float(sys.argv[2])
    print("begin", flush=True)
    start = time.monotonic()
    wait(seconds)
    print(time.monotonic() - start, flush=True)

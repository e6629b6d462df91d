"""Ignores Ctrl-C."""

import signal
import time

signal.signal(signal.SIGINT, signal.SIG_IGN)
print("up", flush=True)
time.sleep(3600)

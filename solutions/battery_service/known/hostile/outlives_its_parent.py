"""Attack: ends at once and leaves a daemon in another session, which would live on when its grade is given.
Outcome: the sandbox ends with the program, and the daemon with it.
Caught by: server_appears
"""

import os
import signal
import time


def main(args=None):
    if os.fork() == 0:
        os.setsid()
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        if os.fork() == 0:
            while True:
                time.sleep(3600.0)
        os._exit(0)
    os._exit(0)


if __name__ == "__main__":
    main()

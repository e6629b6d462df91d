"""The program behind `ros2` in the lab's terminals and cells (`bin/ros2`)."""

from __future__ import annotations

import sys

from ros_cli.app import main

if __name__ == "__main__":
    sys.exit(main())

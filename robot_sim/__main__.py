"""`python -m robot_sim`: the robot node alone."""

from __future__ import annotations

import sys

from robot_sim.body import MissingParts
from robot_sim.ros.serve import build_humanoid, parse_options, serve_robot
from ros_runtime.ros_domain import require_usable_domain


def main() -> None:
    """Run the robot until SIGINT or SIGTERM."""
    options = parse_options()
    try:
        require_usable_domain()
        humanoid = build_humanoid(options)
    except (ValueError, MissingParts) as error:
        sys.exit(f"course sim: {error}")
    serve_robot(options, humanoid)


if __name__ == "__main__":
    main()

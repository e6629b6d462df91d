"""`python -m robot_sim`: the robot node alone."""

from __future__ import annotations

from robot_sim.ros.serve import parse_options, serve_robot


def main() -> None:
    """Run the robot until SIGINT or SIGTERM."""
    serve_robot(parse_options())


if __name__ == "__main__":
    main()

"""`course ros`: runs the course's ros2 commands, which need no ros2cli."""

from __future__ import annotations

import typer

from ros_cli.app import main


def ros(context: typer.Context) -> None:
    """Run a ros2 command with all arguments, including --help."""
    raise SystemExit(main(context.args, program="course ros"))

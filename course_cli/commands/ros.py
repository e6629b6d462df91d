"""`course ros`: the ros2 commands, where ros2cli is not installed."""

from __future__ import annotations

import typer

from ros_cli.app import main


def ros(context: typer.Context) -> None:
    """Run a ros2 command; all arguments go to it, --help too."""
    raise SystemExit(main(context.args, program="course ros"))

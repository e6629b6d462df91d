"""Says in JupyterLab's terminal when everything that it had started has ended."""

from __future__ import annotations

from typing import Any

from autograder.report.console import LineConsole

ENDED = "Ended: JupyterLab, its kernels, and all their robots and nodes. Your notebooks are as last saved."


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": __name__}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Print the line after the server has shut its kernels down, which end their robots and nodes."""
    end_kernels = server.cleanup_kernels

    async def end_kernels_and_say_so() -> None:
        await end_kernels()
        LineConsole().print(f"\n{ENDED}")

    server.cleanup_kernels = end_kernels_and_say_so

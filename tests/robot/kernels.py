"""Notebook kernels to run cells in, as a student's browser does."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import psutil
from jupyter_client.manager import KernelManager, start_new_kernel


class CellError(Exception):
    """A cell raised an exception with the name `name`."""

    def __init__(self, name: str, message: str) -> None:
        super().__init__(f"{name}: {message}")
        self.name = name


class Kernel:
    """A running kernel with `lab` imported, in a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.manager: KernelManager
        self.manager, self.client = start_new_kernel(kernel_name="python3", cwd=str(folder))
        self.run("import lab")

    @property
    def process(self) -> psutil.Process:
        return psutil.Process(self.manager.provisioner.pid)  # type: ignore[union-attr]

    def run(self, code: str, timeout: float = 90.0) -> str:
        """Run a cell, which may be indented, and return what it printed. Raises CellError."""
        printed: list[str] = []

        def keep(message: dict) -> None:
            if message["msg_type"] == "stream":
                printed.append(message["content"]["text"])

        reply = self.client.execute_interactive(dedent(code), timeout=timeout, output_hook=keep)["content"]
        if reply["status"] == "error":
            raise CellError(reply["ename"], reply["evalue"])
        return "".join(printed)

    def children(self) -> list[psutil.Process]:
        return self.process.children(recursive=True)

    def shut_down(self) -> None:
        self.client.stop_channels()
        self.manager.shutdown_kernel()

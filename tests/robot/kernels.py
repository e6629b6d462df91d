"""Notebook kernels to run cells in, as a student's browser does."""

from __future__ import annotations

from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from textwrap import dedent

import psutil
from jupyter_client.manager import KernelManager


class CellError(Exception):
    """A cell raised an exception with the name `name`."""

    def __init__(self, name: str, message: str) -> None:
        super().__init__(f"{name}: {message}")
        self.name = name


class Kernel:
    """A running kernel with `lab` imported, in a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        # not TCP: kernels that start at the same time may choose the same free port, of which one then dies
        self.manager = KernelManager(transport="ipc", connection_file=f"{mkdtemp()}/kernel.json")
        self.manager.start_kernel(cwd=str(folder))
        self.client = self.manager.client()
        self.client.start_channels()
        self.client.wait_for_ready(timeout=60)
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
        rmtree(Path(self.manager.connection_file).parent)

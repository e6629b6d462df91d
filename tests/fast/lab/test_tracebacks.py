"""An interrupted cell names the student's lines only."""

from __future__ import annotations

from pathlib import Path

import pytest
from IPython.core.interactiveshell import InteractiveShell

from lab.tracebacks import announce_interrupts

PROGRAM = """
from concurrent.futures import ThreadPoolExecutor
import signal

def start():
    with ThreadPoolExecutor() as pool:
        pool.submit(signal.raise_signal, signal.SIGINT).result()
"""


def test_an_interrupt_in_a_library_is_shown_in_the_lines_of_the_cell_and_of_the_students_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "walks.py").write_text(PROGRAM, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    shell = InteractiveShell()
    announce_interrupts(shell)
    outcome = shell.run_cell("from walks import start\n\nstart()")
    assert isinstance(outcome.error_in_exec, KeyboardInterrupt)
    assert capsys.readouterr().out.splitlines() == [
        "Cell In[1], line 3: start()",
        f"File {tmp_path}/walks.py, line 7: pool.submit(signal.raise_signal, signal.SIGINT).result()",
        "KeyboardInterrupt: interrupted",
    ]

"""What a cell waits for is said after a second of silence, and leaves no trace in the cell's output."""

from __future__ import annotations

import json

import nbformat
from nbclient import NotebookClient

BEGIN = "import time\nimport lab\nfrom ros_runtime.cell_notice import notice\n"
SLOW = "with notice('The robot is <starting>.'):\n    time.sleep(2.2)\n    print('up')"
QUICK = "with notice('not shown'):\n    print('up')"
NESTED = "with notice('outer'):\n    with notice('inner'):\n        time.sleep(1.5)"
WITH_VARIABLES = "def echo(value):\n    !echo {value} $value{words}\necho(7)"
COMMAND = "!sleep 1.5; true ros2 topic list"


def run(*cells: str) -> tuple[list[nbformat.NotebookNode], list[str]]:
    """The cells of a notebook after its run, and what was displayed or printed, in order."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in (BEGIN, *cells)])
    seen: list[str] = []

    class Client(NotebookClient):
        def process_message(self, message, cell, cell_index):
            content = message["content"]
            if "data" in content or "text" in content:
                seen.append(json.dumps(content.get("data") or content["text"]))
            return super().process_message(message, cell, cell_index)

    Client(notebook).execute()
    return notebook.cells[1:], seen


def test_a_slow_step_is_announced_and_only_its_own_output_stays() -> None:
    (slow, quick, nested, command), seen = run(SLOW, QUICK, NESTED, COMMAND)
    shown = [each for each in seen if "role=" in each and "loading" not in each]
    assert len(shown) == 3
    for part, each in zip(("&lt;starting&gt;", "outer", "ros2 topic list runs"), shown, strict=True):
        assert part in each
    assert any("&lt;starting&gt;" in each and "1 s" in each for each in seen if "role=" not in each)
    assert seen.index(shown[0]) < seen.index(json.dumps("up\n"))
    texts = [
        [output.get("text") or output.data for output in cell.outputs]
        for cell in (slow, quick, nested, command)
    ]
    empty = {"text/plain": ""}
    assert texts == [[empty, "up\n"], ["up\n"], [empty], [empty]]


def test_a_command_in_a_function_sees_the_functions_variables() -> None:
    cells, _ = run(
        WITH_VARIABLES.replace("{words}", " # ros2 node list"), WITH_VARIABLES.replace("{words}", "")
    )
    assert [cell.outputs[0]["text"].strip() for cell in cells] == ["7 7", "7 7"]

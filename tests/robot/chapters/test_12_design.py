"""The cells of chapter 12 show what its text says."""

from __future__ import annotations

from execution import Executed, in_order, numbers

CHAPTER = "12_design"


def test_the_sample_designs_are_drawn_and_the_marks_add_up(chapter: Executed) -> None:
    assert in_order(chapter.html("sample-1-draw"), "A gripper", "line", "GripperCommand")
    assert in_order(chapter.html("sample-2-draw"), "A conveyor", "EmergencyStop")
    sources = {cell.id: cell.source for cell in chapter.notebook.cells}
    for cell, total in (("sample-1-marks", 19), ("sample-2-marks", 6)):
        points = numbers(r"\| (\d) of \d \|", sources[cell])
        assert sum(points) == total
        assert f"**{total} of 20.**" in sources[cell]
        assert sum(numbers(r"\| \d of (\d) \|", sources[cell])) == 20

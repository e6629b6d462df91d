"""Predictions in a kernel: an experiment waits for one, and a new kernel still has it."""

from __future__ import annotations

from pathlib import Path

import pytest
from kernels import CellError, Kernel

PREDICT = 'prediction_1 = lab.predict("services", 1)\nprediction_1'


def test_an_experiment_waits_for_a_prediction_that_outlives_the_kernel(
    own_kernel: Kernel, tmp_path: Path
) -> None:
    own_kernel.run(PREDICT)
    with pytest.raises(CellError, match="Predict first: click a, b or c"):
        own_kernel.run('prediction_1.require()\nprint("the experiment")')
    own_kernel.run('prediction_1.choose("b")')

    restarted = Kernel(tmp_path)
    try:
        restarted.run(PREDICT)
        assert restarted.run('prediction_1.require()\nprint("the experiment")') == "the experiment\n"
        assert restarted.run("prediction_1.reply()").startswith("You predicted b: ")
    finally:
        restarted.shut_down()

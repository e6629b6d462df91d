"""JupyterLab has the course's style and its extension, breaks long output between words, and ends at one Ctrl-C."""

from __future__ import annotations

from pathlib import Path
from typing import Any

c: Any = get_config()  # type: ignore[name-defined]  # noqa: F821  # Jupyter defines it
c.LabApp.custom_css = True
c.ServerApp.answer_yes = True  # else the first Ctrl-C asks a question, and is ignored 5 s later
c.LabApp.extra_labextensions_path = [str(Path(__file__).with_name("labextensions"))]
c.ServerApp.tornado_settings = {"static_custom_path": [str(Path(__file__).with_name("custom"))]}

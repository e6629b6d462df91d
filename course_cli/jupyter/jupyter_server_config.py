"""JupyterLab copies a notebook when it is saved (course_cli/kept_work.py), and has the course's style and extension."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from course_cli.kept_work import keep_saved

c: Any = get_config()  # type: ignore[name-defined]  # noqa: F821  # Jupyter defines it
c.FileContentsManager.post_save_hook = keep_saved
c.LabApp.custom_css = True
c.LabApp.extra_labextensions_path = [str(Path(__file__).with_name("labextensions"))]
c.ServerApp.tornado_settings = {"static_custom_path": [str(Path(__file__).with_name("custom"))]}

"""JupyterLab copies a student's notebook when it is saved (course_cli/kept_work.py)."""

from __future__ import annotations

from typing import Any

from course_cli.kept_work import keep_saved

c: Any = get_config()  # type: ignore[name-defined]  # noqa: F821  # Jupyter defines it
c.FileContentsManager.post_save_hook = keep_saved

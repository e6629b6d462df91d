"""axe-core's findings by WCAG 2.1, levels A and AA, on a page or on a part of it, in the light and the dark scheme."""

from __future__ import annotations

from collections.abc import Mapping

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

TAGS = ("wcag2a", "wcag2aa", "wcag21a", "wcag21aa")
NOTHING: Mapping[str, str] = {}


def require_accessible(page: Page, part: str = "", *, left_out: Mapping[str, str] = NOTHING) -> None:
    """Require that axe-core finds no violation; `part` is the CSS selector of the elements to look at.

    `left_out` has the rules that are not applied, each with the reason.
    """
    if part:
        assert page.locator(part).count(), f"{page.url} has nothing that is {part}"
    options = {
        "resultTypes": ["violations"],
        "runOnly": {"type": "tag", "values": TAGS},
        "rules": {rule: {"enabled": False} for rule in left_out},
    }
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        found = Axe().run(page, part or None, options)
        assert found.violations_count == 0, f"{page.url}, {scheme}: {found.generate_report()}"

"""axe-core's findings by WCAG 2.1, levels A and AA, on a page or on a part of it, in the light and the dark scheme."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

from axe_playwright_python.base import AxeResults
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

TAGS = ("wcag2a", "wcag2aa", "wcag21a", "wcag21aa")
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
NOTHING: Mapping[str, str] = {}


def violations(page: Page, part: str = "", left_out: Iterable[str] = ()) -> AxeResults:
    """What axe-core finds in the elements with the CSS selector `part`, or on the whole page, by all rules but some."""
    options = {
        "resultTypes": ["violations"],
        "runOnly": {"type": "tag", "values": TAGS},
        "rules": {rule: {"enabled": False} for rule in left_out},
    }
    return Axe().run(page, part or None, options)


def require_accessible(page: Page, part: str = "", *, left_out: Mapping[str, str] = NOTHING) -> None:
    """Require that axe-core finds nothing; `left_out` has the rules that are not applied, each with the reason."""
    assert not part or page.locator(part).count(), f"{page.url} has no element {part}"
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme)
        found = violations(page, part, left_out)
        assert found.violations_count == 0, f"{page.url}, {scheme}: {found.generate_report()}"

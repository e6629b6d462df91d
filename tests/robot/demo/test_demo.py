"""The README's first command, as a newcomer runs it."""

import json
import subprocess
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[3]


class Page(HTMLParser):
    """Counts the visible parts of a page."""

    def __init__(self, text):
        super().__init__()
        self.pictures, self.headings, self._heading = [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.pictures.append(dict(attributes))
        self._heading = tag == "h2"

    def handle_data(self, data):
        if self._heading:
            self.headings.append(data)
            self._heading = False


def test_the_demo_walks_cancels_grades_and_leaves_a_report(tmp_path):
    result = subprocess.run(
        [PROJECT / "course", "demo", "--out", tmp_path], capture_output=True, text=True, timeout=900, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert "SUCCEEDED" in result.stdout
    assert "CANCELED" in result.stdout

    right, ignores_cancel, crashes = json.loads((tmp_path / "grades.json").read_text())
    assert right["score"] == right["max_score"]
    failed = {check["id"] for check in ignores_cancel["checks"] if check["status"] == "failed"}
    assert failed == {"cancels_in_mid_stride"}
    assert crashes["score"] < ignores_cancel["score"] < right["score"]

    html = (tmp_path / "report.html").read_text()
    page = Page(html)
    assert page.headings == ["Submission: right", "Submission: ignores cancel", "Submission: crashes"]
    assert all(picture["src"].startswith("data:image/png") and picture["alt"] for picture in page.pictures)
    assert page.pictures
    first_diagram = html[html.index("<svg") : html.index("</svg>") + len("</svg>")]
    assert "goal accepted" in ElementTree.fromstring(first_diagram).findtext("{*}desc", "")

"""The pages for instructors and students after a batch, made from invented grades."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from urllib.parse import unquote

import pytest
from bs4 import BeautifulSoup, Tag

from autograder.authoring.lesson import in_words
from autograder.classroom.nbgrader_bridge.generated_cells import HIDDEN_HELP
from autograder.classroom.pages.history import read_history, with_day, write_history
from autograder.classroom.pages.pages import write_class_page, write_student_page, write_submission_pages
from autograder.engine.verdict import CheckVerdict, Grade

MARKUP = "<img src=x onerror=alert(1)>"
HOSTILE = f'o\'neil, {MARKUP} & "co" #1 100%'
SECRETS = (
    "It survives a second goal",
    "a goal at 4.2 m",
    "it fell",
    "Hold the second goal",
    "seed 7",
    "secret_goal",
)
BOTH = ("pages", "instructor")


def check(id, status="passed", *, title="", points=None, most=2, **more):
    earned = points if points is not None else most * (status == "passed")
    return CheckVerdict(id, title or f"The title of {id}", status, earned, most, **more)


def failed(id="walks", **more):
    words = {
        "expected": "a robot at 1 m",
        "observed": "a robot at 0 m",
        "help": "Publish cmd_vel.",
        "robot_time": 3.25,
    }
    return check(id, "failed", **(words | more))


def hidden(status):
    expected, observed, help, log = SECRETS[1:5]
    return check(
        SECRETS[5],
        status,
        title=SECRETS[0],
        hidden=True,
        expected=expected,
        observed=observed,
        help=help,
        log=log,
        robot_time=8.75,
    )


def grade(student, *checks, exercise="walk_to", **more):
    return Grade(exercise, student, "namespaces", list(checks), **more)


def pages_of(folder: Path, *grades: Grade, left_out=()) -> Path:
    for each in grades:
        write_submission_pages(folder, each, {})
        write_student_page(folder, each.student, [one for one in grades if one.student == each.student])
    return write_class_page(folder, grades, left_out)


def read(path: Path) -> BeautifulSoup:
    """A page, parsed; it may neither run a script nor load anything."""
    page = BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser")
    assert not page.find_all(["script", "link", "iframe", "object", "img"])
    assert not [tag for tag in page.find_all(True) for name in tag.attrs if name.startswith("on")]
    ids = [tag["id"] for tag in page.find_all(id=True)]
    assert len(ids) == len(set(ids))
    return page


def words(tag: Tag | BeautifulSoup) -> str:
    return re.sub(r"\s+([,;:.])", r"\1", " ".join(tag.get_text(" ").split()))


def section(page: BeautifulSoup, heading: str) -> str:
    """The text below a heading, up to the next heading."""
    start = page.find("h2", string=re.compile(heading))
    assert isinstance(start, Tag)
    text = []
    for tag in start.find_next_siblings():
        if tag.name == "h2":
            break
        text.append(words(tag))
    return " ".join(text)


def rows(page: BeautifulSoup, caption: str) -> list[list[str]]:
    """The cells of the table with this caption."""
    title = page.find("caption", string=re.compile(caption))
    assert isinstance(title, Tag)
    table = title.find_parent("table")
    assert isinstance(table, Tag)
    return [[words(cell) for cell in row.find_all(["th", "td"])] for row in table.select("tbody tr")]


def test_the_hardest_checks_are_first_with_the_observations_of_their_failures(tmp_path):
    easy, hard = failed("easy", help="Rarely said."), failed("hard", help="Often said.")
    never_made = check("late", "not run", help="Needs another.")
    grades = [
        grade("anna", check("easy"), check("hard"), check("late")),
        grade("bert", check("easy"), hard, check("late")),
        grade("carl", check("easy"), hard, failed("late", help="Said to one.")),
        grade("dora", easy, failed("hard", help="Said once."), never_made),
    ]
    page = read(pages_of(tmp_path, *grades))
    assert rows(page, "Hardest checks of walk_to") == [
        ["The title of hard", "75 % (3 of 4)", "", "Often said."],
        ["The title of late", "33 % (1 of 3)", "1", "Said to one."],
        ["The title of easy", "25 % (1 of 4)", "", "Rarely said."],
    ]


def test_the_class_is_compared_with_the_days_on_which_something_else_failed(tmp_path):
    fails = [grade(name, failed("hard"), check("easy")) for name in ("anna", "bert")]
    halves = [fails[0], grade("bert", check("hard"), check("easy"))]
    rows_then = with_day(with_day((), "2026-10-05", fails), "2026-10-06", fails)
    assert [(row.day, row.check, row.failed, row.judged) for row in rows_then] == [
        ("2026-10-05", "hard", "2", "2")
    ]
    write_history(tmp_path, with_day(rows_then, "2026-10-12", halves))
    kept = read_history(tmp_path)
    assert kept == with_day(rows_then, "2026-10-12", halves)
    page = read(write_class_page(tmp_path, halves, history=kept[:1]))
    assert rows(page, "Hardest checks")[0][1] == "50 % (1 of 2) 100 % on 2026-10-05"


def test_lessons_to_repeat_are_those_of_the_most_students_in_all_exercises(tmp_path):
    frames, feedback = "02_services#m9-why", "02_services#m4-why"
    page = pages_of(
        tmp_path,
        grade("anna", failed("a", lesson=feedback), failed("b", lesson=feedback)),
        grade("bert", failed("a", lesson=frames), check("b", "not run", lesson=feedback)),
        grade("bert", failed("x", lesson=frames), exercise="walk_client"),
        grade("carl", failed("x", lesson=frames), exercise="walk_client"),
    )
    assert rows(read(page), "Lessons to which failed checks refer, those of the most students first") == [
        [in_words(frames), "2", "walk_client 2, walk_to 1"],
        [in_words(feedback), "1", "walk_to 1"],
    ]


def test_the_drawing_of_the_scores_has_a_text_alternative(tmp_path):
    full = grade("anna", check("a"), check("b"))
    half = [grade(name, check("a"), failed("b")) for name in ("bert", "carl")]
    page = read(pages_of(tmp_path, full, *half))
    drawing = page.find("svg")
    assert isinstance(drawing, Tag)
    assert drawing["role"] == "img"
    assert words(drawing.find("title")) == "Scores of walk_to"
    said = words(drawing.find("desc"))
    assert said == "submissions by points, % of the maximum: 50–59: 2, 100: 1."
    assert "3 graded, median 2 of 4 points" in section(page, "^walk_to$")


def test_students_who_need_help_are_listed_with_topics(tmp_path):
    page = read(
        pages_of(
            tmp_path,
            grade("anna", check("a"), check("b"), check("c")),
            grade("bert", check("a"), failed("b"), failed("c")),
            grade("carl", *(failed(id) for id in "abcde")),
        )
    )
    assert rows(page, "Less than 60 %") == [
        ["carl", "walk_to", "0/10 (0 %)", "The title of a; The title of b; The title of c; and 2 more"],
        ["bert", "walk_to", "2/6 (33 %)", "The title of b; The title of c"],
    ]
    assert "Nobody" in section(read(pages_of(tmp_path, grade("anna", check("a")))), "Who needs help")


def test_what_was_not_graded_is_first_with_its_reason_and_what_to_do(tmp_path):
    reason = "the grader itself failed:\nTraceback (most recent call last):\nOSError: no space left on device"
    page = read(
        pages_of(
            tmp_path,
            grade("anna", check("a")),
            grade("bert", reason=reason),
            left_out=["the folder 'c*': rename it"],
        )
    )
    assert page.find_all("h2")[0].text == "Not graded, and why"
    said = section(page, "Not graded")
    assert "bert, walk_to: the grader itself failed: OSError: no space left on device" in said
    assert "the folder 'c*': rename it" in said
    assert "--resume" in said
    assert "1 graded, 1 not graded, 0 to be marked by hand" in words(page)
    assert "OSError" in words(read(tmp_path / "instructor/bert/walk_to.html"))
    seen = words(read(tmp_path / "pages/bert/walk_to.html"))
    assert "Not graded: no score" in seen
    assert "not your fault" in seen
    assert "OSError" not in seen


def test_the_student_of_a_waiting_essay_sees_no_partial_points(tmp_path):
    essay = grade("anna", check("graph", "marked", points=1.5), check("qos", "to mark"), exercise="essay")
    page = read(pages_of(tmp_path, essay))
    assert "anna, essay: 1 of 2 criteria are not marked yet" in section(page, "To be marked by hand")
    assert "No scores yet; 1 to be marked by hand" in section(page, "^essay$")
    assert rows(read(tmp_path / "instructor/anna/essay.html"), "Every check")[0][1:] == ["1.5/2", "• marked"]
    for row in rows(read(tmp_path / "pages/anna/essay.html"), "Every check"):
        assert row[1:] == ["–/2", "… to mark"]


def test_an_empty_class_says_so(tmp_path):
    assert "Nothing was graded." in words(read(pages_of(tmp_path)))
    page = read(pages_of(tmp_path, left_out=["the folder 'c*': rename it"]))
    assert "the folder 'c*': rename it" in section(page, "Not graded")


@pytest.mark.parametrize("status", ["passed", "failed", "not run"])
def test_a_student_sees_only_whether_a_hidden_check_passed(tmp_path, status):
    drawings = {
        SECRETS[5]: ["<svg><desc>secret drawing</desc></svg>"],
        "walks": ["<svg><desc>a walk</desc></svg>"],
    }
    write_submission_pages(tmp_path, grade("anna", failed(), hidden(status)), drawings)
    theirs, ours = (tmp_path / top / "anna/walk_to.html" for top in BOTH)
    assert not [
        secret for secret in (*SECRETS, "8.7", "8.8", "secret drawing") if secret in theirs.read_text()
    ]
    walk, secret = rows(read(theirs), "Every check")
    assert walk[0] == (
        "The title of walks expected a robot at 1 m observed a robot at 0 m (at 3.2 s) next Publish cmd_vel. "
        "what happened a walk"
    )
    seen = (
        ["Hidden check 1", "2/2", "✓ passed"]
        if status == "passed"
        else [
            f"Hidden check 1 next {HIDDEN_HELP}",
            "0/2",
            "✗ failed",
        ]
    )
    assert secret == seen
    its_clause = replace(hidden(status), promise="clause 4, “It answers.”")
    write_submission_pages(tmp_path, grade("ben", failed(), its_clause), drawings)
    told = words(read(tmp_path / BOTH[0] / "ben/walk_to.html"))
    assert ("It checks clause 4, “It answers.”" in told) == (status != "passed")
    assert "For the student." in words(read(theirs))
    assert "instructor" not in " ".join(link["href"] for link in read(theirs).find_all("a"))

    text = words(read(ours))
    assert "For the instructor only." in text
    assert f"{SECRETS[0]} (hidden)" in text
    if status != "passed":
        assert not [secret for secret in (*SECRETS[:5], "secret drawing") if secret not in text]


def test_a_students_text_is_escaped(tmp_path):
    shouting = failed(
        expected=MARKUP, observed=f"</dd>{MARKUP}", help="{{ 7 * 7 }}", log=f"</pre>{MARKUP}\ud800\x00\u202e"
    )
    broken = grade("bert", reason=f"{MARKUP}\n{MARKUP}")
    page = read(pages_of(tmp_path, grade(HOSTILE, shouting), broken, left_out=[MARKUP]))
    assert words(page).count(MARKUP) >= 5  # bert's reason twice, the ignored folder, and HOSTILE's name
    for top in BOTH:
        text = words(read(tmp_path / top / HOSTILE / "walk_to.html"))
        assert text.count(MARKUP) >= 4
        assert "{{ 7 * 7 }}" in text
        assert f"walk_to · {HOSTILE}" in text


def test_every_link_leads_to_a_page_and_every_page_is_linked(tmp_path):
    grades = [
        grade(HOSTILE, failed()),
        grade("anna", check("walks")),
        grade("anna", failed(), exercise="essay"),
    ]
    class_page = pages_of(tmp_path, *grades)
    reached = {class_page.resolve()}
    for path in [class_page, *tmp_path.rglob("*/*/*.html")]:
        for link in read(path).find_all("a"):
            place, _, anchor = link["href"].partition("#")
            target = (path.parent / unquote(place)).resolve() if place else path
            reached.add(target)
            assert not anchor or read(target).find(id=anchor), link
    assert reached == {path.resolve() for path in tmp_path.rglob("*.html")}


def test_a_student_finds_every_exercise_on_a_page_of_their_own(tmp_path):
    walked, waiting = (
        grade("anna", check("a"), hidden("failed")),
        grade("anna", check("qos", "to mark"), exercise="essay"),
    )
    lost = grade("anna", reason="OSError: no space left on device", exercise="fetch")
    pages_of(tmp_path, walked, waiting, lost, grade("bert", check("a")))
    page = tmp_path / "pages/anna/index.html"
    assert rows(read(page), "All submitted exercises") == [
        ["essay", "to mark"],
        ["fetch", "not graded"],
        ["walk_to", "2/4"],
    ]
    assert [link["href"] for link in read(page).select("td a, th a")] == [
        "essay.html",
        "fetch.html",
        "walk_to.html",
    ]
    assert not [secret for secret in (*SECRETS, "OSError", "bert") if secret in page.read_text()]


def test_checks_of_one_run_share_their_drawing(tmp_path):
    run = ["<svg><desc>one run</desc></svg>"]
    write_submission_pages(tmp_path, grade("anna", failed("a"), failed("b")), {"a": run, "b": list(run)})
    first, second = rows(read(tmp_path / "pages/anna/walk_to.html"), "Every check")
    assert first[0].endswith("what happened one run")
    assert second[0].endswith("what happened: see the drawing at The title of a")


@pytest.mark.parametrize("name", ["../mallory", "..", "", "a/b"])
def test_a_name_that_leads_elsewhere_is_refused(tmp_path, name):
    with pytest.raises(ValueError, match="cannot be the name of a folder"):
        write_submission_pages(tmp_path / "out", grade(name, check("a")), {})
    assert not list(tmp_path.rglob("*.html"))


def test_only_the_class_page_has_the_grading_settings_and_the_seed(tmp_path):
    batch = {"seed of hidden checks": "314159", "isolation": MARKUP}
    graded = grade("anna", failed(), seed=314159)
    assert "How it was graded" not in words(read(pages_of(tmp_path, graded)))
    page = read(write_class_page(tmp_path, [graded], batch=batch))
    assert "314159" in words(page)
    assert MARKUP in words(page)
    assert "314159" not in (tmp_path / "pages/anna/walk_to.html").read_text()

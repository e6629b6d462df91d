"""The latest real work in a submitted folder is graded, whatever its file's name; the other files are named."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
import typer
from nbformat.v4 import new_code_cell, new_notebook, writes

from autograder import self_check as module
from autograder.classroom.batch.collection import collect, files_of_exercises
from autograder.engine import starter
from autograder.engine.hand_in import Names
from autograder.engine.starter import is_starter, what_is_to_be_written
from autograder.engine.submission import Submission, UnusableSubmission, read_submission
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.hand_in_notice import next_step
from course_cli import own_work as own_work_module
from course_cli import reasons_not_to_submit
from course_cli.commands import submit as command
from course_cli.own_work import own_work
from ros_runtime.project import PROJECT
from ros_runtime.self_checks import LastCheck

NAME = "battery_service"
STARTER = PROJECT / f"exercises/{NAME}/{NAME}.ipynb"
WORK, OTHER = "work = 1\n", "other = 1\n"
HOUR = 3600.0  # s


@pytest.fixture(autouse=True)
def own_progress_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep the submissions of these tests out of this clone's progress file."""
    monkeypatch.setattr(command, "FILE", tmp_path / ".progress.json")
    monkeypatch.setattr(module, "store_check", lambda *_, **options: None)


def notebook(program: str = WORK) -> str:
    return writes(new_notebook(cells=[new_code_cell(f"%%writefile {NAME}.py\n{program}")]))


def put(folder: Path, *files: str | tuple[str, str]) -> None:
    """Write files that contain work, or the given text; each is an hour newer than the previous one."""
    for number, file in enumerate(files):
        name, text = file if isinstance(file, tuple) else (file, "")
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text or (notebook() if ".ipynb" in name.lower() else WORK))
        os.utime(path, (number * HOUR, number * HOUR))


@pytest.mark.parametrize(
    "name",
    [
        *(f"{NAME} (1).ipynb", f"{NAME}(2).py", f"{NAME}-1.py", f"{NAME} (1)-1.ipynb", f"{NAME} 2.ipynb"),
        *(
            f"{NAME}-Copy1.ipynb",
            f"{NAME}-Copy12-3.ipynb",
            f"Copy of {NAME}.ipynb",
            f"Kopie von {NAME}.ipynb",
        ),
        *(f"{NAME} - Kopie (2).py", f"{NAME} copy.py", f"{NAME} (another copy).py", f"Cópia de {NAME}.ipynb"),
        *("Battery_Service.IPYNB", "battery service.py", "Battery-Service.py", f"{NAME}.副本.py"),
        *(f"{NAME}.ipynb.txt", f"{NAME}.ipynb.json", f"{NAME}.py.txt", f"{NAME}.py.py"),
    ],
)
def test_a_copy_belongs_to_its_exercise_whatever_program_named_it(tmp_path: Path, name: str) -> None:
    for place in ("anna/", "bert/battery_service/", "carla/work/", "dora/Battery_Service/sub/"):
        put(tmp_path, place + name)
    works = collect(tmp_path).works
    assert [(work.student, work.exercise) for work in works] == [
        (student, NAME) for student in ("anna", "bert", "carla", "dora")
    ]
    assert {work.read().sources[f"{NAME}.py"] for work in works} == {WORK}


@pytest.mark.parametrize(
    "name",
    ["test_battery_service.py", "battery_service_client.py", "battery.py", "battery_service.txt", "x.tar.gz"],
)
def test_a_file_with_another_name_belongs_to_no_exercise(name: str) -> None:
    assert Names(files_of_exercises()).of(name) is None


def test_in_the_exercises_own_folder_any_name_is_accepted(tmp_path: Path) -> None:
    put(tmp_path, "anna/battery_service/final version.ipynb", "bert/final version.ipynb")
    put(tmp_path / "anna/battery_service", ("a file.py", ""), ("where_am_i.py", OTHER))
    collection = collect(tmp_path)
    (work,) = collection.works
    assert work.read().sources == {f"{NAME}.py": WORK}
    assert "bert handed in none of" in collection.ignored[0]
    assert collection.ignored[0].endswith("their folder holds final version.ipynb")


FIRST, SECOND = f"{NAME}.py", f"{NAME} (1).py"
CASES = {
    "the later one": ([(SECOND, OTHER), FIRST], f"{SECOND} is older than {FIRST}"),
    "also if it is a copy": (
        [(FIRST, OTHER), f"{NAME}-Copy1.ipynb"],
        f"{FIRST} is older than {NAME}-Copy1.ipynb",
    ),
    "never the starter": (
        [f"{NAME}-Copy1.ipynb", (f"{NAME}.ipynb", "starter")],
        f"{NAME}.ipynb is the unchanged starter",
    ),
    "nor what it writes": ([f"{NAME}-Copy1.ipynb", (FIRST, "its file")], f"{FIRST} is the unchanged starter"),
    "nor one at the top": (
        [f"sub/{FIRST}", (f"{NAME}.ipynb", "starter")],
        f"{NAME}.ipynb is the unchanged starter",
    ),
    "never a nested one": ([FIRST, (f"old/{FIRST}", OTHER)], f"old/{FIRST} lies deeper than {FIRST}"),
    "what can be read": (
        [FIRST, (f"{NAME}.ipynb", "{")],
        f"{NAME}.ipynb cannot be read: {NAME}.ipynb is not a note",
    ),
    "never its export": (
        [f"{NAME}.ipynb", (FIRST, f"get_ipython().run_cell_magic('writefile', '{FIRST}', 'work = 1')\n")],
        f"{FIRST} cannot be read: {FIRST} is a notebook that was exported as a script",
    ),
    "the notebook": ([(FIRST, OTHER), f"{NAME}.ipynb"], f"{FIRST} is older than {NAME}.ipynb"),
    "nothing to say of the same": ([FIRST, f"{NAME}.ipynb", f"old/{FIRST}"], ""),
    "nothing of what examples write": ([FIRST, (f"{NAME}/where_am_i.py", OTHER)], ""),
    "no installed package": ([FIRST, (f"venv/lib/site-packages/{FIRST}", OTHER)], ""),
}


def put_case(folder: Path, files: list) -> None:
    texts = {"starter": STARTER.read_text()}
    if any(file[1] == "its file" for file in files):
        from autograder.engine.submission import read_submission

        texts["its file"] = read_submission(STARTER, NAME).sources[FIRST]
    put(
        folder,
        *((file[0], texts.get(file[1], file[1])) if isinstance(file, tuple) else file for file in files),
    )


@pytest.mark.parametrize(("files", "line"), CASES.values(), ids=CASES)
@pytest.mark.parametrize("home", ["anna", f"anna/{NAME}"])
def test_one_of_several_files_counts_and_the_others_are_named(
    tmp_path: Path, files: list, line: str, home: str
) -> None:
    put_case(tmp_path / home, files)
    (work,) = collect(tmp_path).works
    assert work.read().sources == {FIRST: WORK}
    within = Path(home).relative_to("anna")
    said = [one.replace(f"{within}/", "") for one in work.left_aside]
    assert len(said) == bool(line)
    assert all(one.startswith(f"anna: {line}") for one in said)


def test_files_with_the_same_time_are_ordered_by_their_names(tmp_path: Path) -> None:
    """What was cloned or unpacked together: the notebook first, then numbers upwards, then copies."""
    order = [f"{NAME}.ipynb", f"{NAME} (2).py", f"{NAME} (1).py", f"{NAME}.py", f"{NAME}-Copy1.py"]
    for number, name in enumerate(order):
        text = f"number = {number}\n"
        put(tmp_path / "anna", (name, notebook(text) if name.endswith("ipynb") else text))
    for number, name in enumerate(order):
        (work,) = collect(tmp_path).works
        assert work.read().sources == {FIRST: f"number = {number}\n"}
        (tmp_path / "anna" / name).unlink()


def test_why_a_file_of_the_same_time_does_not_count_is_no_order_in_time(tmp_path: Path) -> None:
    for place in (
        f"anna/{NAME}.ipynb",
        (f"anna/{FIRST}", OTHER),
        f"bert/{FIRST}",
        (f"bert/{NAME}-Copy1.py", OTHER),
    ):
        put(tmp_path, place)
    assert [line for work in collect(tmp_path).works for line in work.left_aside] == [
        f"anna: {FIRST} was saved within a minute of {NAME}.ipynb, and a notebook counts first; their programs differ",
        f"bert: {NAME}-Copy1.py was saved within a minute of {FIRST}, and that name counts first; "
        "their programs differ",
    ]


def test_an_unchanged_starter_is_the_submission_if_there_is_no_other(tmp_path: Path) -> None:
    put(tmp_path, (f"anna/{NAME}/{NAME}.ipynb", STARTER.read_text()))
    (work,) = collect(tmp_path).works
    assert "# YOUR CODE HERE" in work.read().sources[FIRST]
    assert work.left_aside == []


def test_copies_of_several_files_make_one_work(tmp_path: Path) -> None:
    put(
        tmp_path / "anna/work",
        "GetBatteryStatus (1).srv",
        ("getbatterystatus.srv", OTHER),
        "NavigateToPose-Copy1.action",
    )
    (work,) = collect(tmp_path).works
    assert work.read().sources == {"GetBatteryStatus.srv": WORK, "NavigateToPose.action": WORK}


def test_a_file_in_the_folder_of_another_exercise_is_not_taken(tmp_path: Path) -> None:
    put(tmp_path / "anna", f"walk_to/{FIRST}", "walk_to/walk_to.py")
    assert [work.exercise for work in collect(tmp_path).works] == ["walk_to"]


@pytest.mark.parametrize(("files", "line"), CASES.values(), ids=CASES)
def test_check_and_grade_choose_the_same_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture, files: list, line: str
) -> None:
    monkeypatch.chdir(tmp_path)
    put_case(tmp_path / "exercises" / NAME, files)
    for given in (None, Path("exercises") / NAME):
        path, left_aside = own_work(NAME, given)
        assert read_submission(path, NAME).sources == {FIRST: WORK}
        assert [one[: len(line)] for one in left_aside] == ([line] if line else [])


def test_the_exercise_of_the_course_is_found_from_any_folder_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(own_work_module, "WORK", tmp_path)
    put(tmp_path, f"exercises/{NAME}/{NAME}.ipynb", "chapters/programs/walk.py")
    for place in ("chapters", "chapters/programs"):
        monkeypatch.chdir(tmp_path / place)
        path, _ = own_work(NAME, None)
        assert path.resolve() == tmp_path / f"exercises/{NAME}/{NAME}.ipynb"
    with pytest.raises(UnusableSubmission, match=r"name your file: \./course check walk_to FILE"):
        own_work("walk_to", None)
    with pytest.raises(UnusableSubmission, match=r"name your file: \./course submit walk_to --file FILE"):
        command.submit(["walk_to"])


def test_a_file_of_another_exercise_is_not_checked(tmp_path: Path) -> None:
    with pytest.raises(
        UnusableSubmission, match=r"walk_to\.py is a file of walk_to: \./course check walk_to .*walk_to\.py"
    ):
        own_work(NAME, tmp_path / "walk_to.py")


def test_check_finds_work_in_a_folder_below(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    put(tmp_path, f"work/{SECOND}")
    assert own_work(NAME, None) == (Path("work") / SECOND, [])


@pytest.mark.parametrize(("saved", "said"), [(WORK, "Next: hand it in"), (OTHER, "save it (Ctrl+S)")])
def test_a_self_check_says_whether_what_was_checked_is_saved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture, saved: str, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    checked = Submission(NAME, "you", {FIRST: WORK}).fingerprint

    def check_with_progress(*_: object, **__: object) -> Grade:
        print("the verdicts")
        passed = CheckVerdict("check", "Title", "passed", 1, 1)
        return Grade(NAME, "me", "none", [passed], program=checked)

    monkeypatch.setattr(module, "check_with_progress", check_with_progress)
    put(tmp_path, FIRST, (f"{NAME}.ipynb", notebook(saved)))
    module.self_check(NAME)
    printed = capsys.readouterr().out
    before, after = printed.split("the verdicts")
    assert said in after
    assert (said in before) == (saved != WORK)  # nobody overlooks a warning
    assert "hidden checks add" in printed
    assert "in other situations" in " ".join(printed.split())


def test_submit_writes_what_a_grader_takes_and_says_what_it_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    checked = {fingerprint(WORK): LastCheck(3, 4, "2026-11-27T10:00:00")}
    monkeypatch.setattr(reasons_not_to_submit, "last_check_of", lambda program, _: checked.get(program))
    put(tmp_path / "exercises" / NAME, FIRST, f"{NAME} (1).ipynb.txt")
    for name in ("GetBatteryStatus.srv", "NavigateToPose.action"):
        put(tmp_path / "exercises/interfaces", name)
    command.submit([NAME, "interfaces"])

    handed_in = tmp_path / "hand_in"
    assert sorted(path.name for path in handed_in.iterdir()) == [f"{NAME}.ipynb", "interfaces.zip"]
    assert read_submission(handed_in / f"{NAME}.ipynb", NAME).sources == {FIRST: WORK}
    printed = " ".join(capsys.readouterr().out.split())
    assert f"{NAME}.ipynb: {FIRST}, 1 line, as saved" in printed
    assert f"fingerprint {fingerprint(WORK)}" in printed
    assert "Last self-check of this program: 3 of 4 visible checks passed" in printed
    assert (
        "This program has not been checked. Next: ./course check interfaces; then hand in what is" in printed
    )


def test_a_cell_submits_to_the_top_of_the_course_and_a_replaced_program_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr(command, "WORK", tmp_path)
    folder = tmp_path / "exercises" / NAME
    put(folder, f"{NAME}.ipynb")
    monkeypatch.chdir(folder)
    command.submit([NAME])
    command.submit([NAME])
    assert "replaces" not in capsys.readouterr().out

    put(folder, (f"{NAME}.ipynb", notebook(OTHER)))
    command.submit([NAME])
    before = Submission(NAME, "", {FIRST: WORK}).fingerprint
    assert f"it replaces another program, fingerprint {before}" in capsys.readouterr().out
    assert [path.name for path in (tmp_path / "hand_in").iterdir()] == [f"{NAME}.ipynb"]


def test_submit_keeps_a_program_that_runs_when_python_cannot_run_the_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    checked = {fingerprint(WORK): LastCheck(7, 7, "2026-11-27T10:00:00")}
    monkeypatch.setattr(reasons_not_to_submit, "last_check_of", lambda program, _: checked.get(program))
    handed_in = tmp_path / "hand_in" / f"{NAME}.ipynb"
    put(tmp_path, (f"{NAME}.ipynb", notebook("x = 1\ny = (2\n")))
    with pytest.raises(typer.Exit):  # there is nothing else to hand in
        command.submit([NAME])
    assert "y = (2" in handed_in.read_text(encoding="utf-8")
    assert f"{NAME}.ipynb: line 2 of {FIRST}: '(' was never closed" in capsys.readouterr().out

    put(tmp_path, (f"{NAME}.ipynb", notebook(WORK)))
    command.submit([NAME])
    put(tmp_path, (f"{NAME}.ipynb", notebook("y = (2\n")))
    capsys.readouterr()
    with pytest.raises(typer.Exit):
        command.submit([NAME])
    assert read_submission(handed_in, NAME).sources == {FIRST: WORK}
    printed = " ".join(capsys.readouterr().out.split())
    assert f"it keeps fingerprint {fingerprint(WORK)}: 7 of 7 visible checks passed" in printed
    assert printed.count("Next:") == 1

    checked[fingerprint(OTHER)] = LastCheck(7, 7, "2026-11-27T11:00:00")
    put(tmp_path, (f"{NAME}.ipynb", notebook(OTHER)))
    command.submit([NAME])
    assert f"another program, fingerprint {fingerprint(WORK)}: 7 of 7" in printed_by(capsys)


def test_a_program_that_passed_fewer_checks_replaces_no_better_one_until_that_is_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    checked = {fingerprint(WORK): LastCheck(8, 8, "2026-11-27T10:00:00")}
    monkeypatch.setattr(reasons_not_to_submit, "last_check_of", lambda program, _: checked.get(program))
    handed_in = tmp_path / "hand_in" / f"{NAME}.ipynb"
    put(tmp_path, f"{NAME}.ipynb")
    command.submit([NAME])
    put(tmp_path, (f"{NAME}.ipynb", notebook(OTHER)))
    keeps = f"it keeps fingerprint {fingerprint(WORK)}: 8 of 8 visible checks passed"
    for now in ("not checked yet", "3 of 8 visible checks passed"):
        capsys.readouterr()
        with pytest.raises(typer.Exit):
            command.submit([NAME])
        said = printed_by(capsys)
        assert f"{keeps}; this program: {now}" in said
        assert f"Next: ./course check {NAME}, and submit again" in said
        assert said.endswith(f"to hand it in all the same, remove {os.path.relpath(handed_in)}.")
        assert read_submission(handed_in, NAME).sources == {FIRST: WORK}
        checked[fingerprint(OTHER)] = LastCheck(3, 8, "2026-11-27T11:00:00")
    handed_in.unlink()
    command.submit([NAME])
    assert read_submission(handed_in, NAME).sources == {FIRST: OTHER}


def printed_by(capsys: pytest.CaptureFixture) -> str:
    return " ".join(capsys.readouterr().out.split())


def fingerprint(text: str) -> str:
    return Submission(NAME, "", {FIRST: text}).fingerprint


def test_one_file_of_an_exercise_is_handed_in_and_the_replaced_one_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    work, handed_in = tmp_path / "exercises" / NAME, tmp_path / "hand_in"
    put(work, f"{NAME}.ipynb")
    command.submit([NAME])
    put(work, f"{NAME}.ipynb", (FIRST, OTHER))
    command.submit([NAME])
    said = printed_by(capsys)
    assert f"{NAME}.ipynb is older than {FIRST}; their programs differ" in said
    assert f"it replaces {NAME}.ipynb: another program, fingerprint {fingerprint(WORK)}" in said
    assert [path.name for path in handed_in.iterdir()] == [FIRST]

    put(work, (FIRST, OTHER), (f"{NAME}.ipynb", notebook(OTHER)))
    command.submit([NAME])
    assert f"it replaces {FIRST}: the same program" in printed_by(capsys)
    assert [path.name for path in handed_in.iterdir()] == [f"{NAME}.ipynb"]


def test_submit_removes_only_what_it_wrote(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    put(tmp_path / "exercises" / NAME, f"{NAME}.ipynb")
    own = tmp_path / "hand_in" / FIRST
    put(own.parent, (FIRST, OTHER), "notes.txt")
    command.submit([NAME])
    said = printed_by(capsys)
    assert f"{FIRST} stays: submit did not write it" in said
    assert f"{FIRST} unless it is what you mean to hand in; then hand in" in said
    assert own.read_text() == OTHER
    assert (own.parent / "notes.txt").exists()

    own.unlink()
    put(tmp_path / "exercises" / NAME, f"{NAME}.ipynb", (FIRST, OTHER))
    command.submit([NAME])
    own.write_text("edited = 1\n")  # after it was written
    put(tmp_path / "exercises" / NAME, FIRST, f"{NAME}.ipynb")
    command.submit([NAME])
    assert own.read_text() == "edited = 1\n"
    with pytest.raises(typer.BadParameter, match="your own"):
        command.submit([NAME], out=tmp_path / "exercises" / NAME)


def test_a_zip_of_several_files_and_a_notebook_replace_one_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    names = ("GetBatteryStatus.srv", "NavigateToPose.action")
    before = Submission("interfaces", "", dict.fromkeys(names, WORK)).fingerprint
    put(tmp_path / "exercises/interfaces", *names)
    command.submit(["interfaces"])
    cells = [new_code_cell(f"%%writefile {name}\n{OTHER}") for name in names]
    put(
        tmp_path / "exercises/interfaces",
        names[0],
        names[1],
        ("interfaces.ipynb", writes(new_notebook(cells=cells))),
    )
    command.submit(["interfaces"])
    assert f"it replaces interfaces.zip: another program, fingerprint {before}" in printed_by(capsys)
    assert [path.name for path in (tmp_path / "hand_in").iterdir()] == ["interfaces.ipynb"]


def test_submit_says_that_nothing_is_filled_in_and_keeps_earlier_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    starter = (f"{NAME}.ipynb", STARTER.read_text())
    put(tmp_path, starter)
    with pytest.raises(typer.Exit):
        command.submit([NAME])
    said = printed_by(capsys)
    assert f"{NAME}.ipynb is the starter as it was given out, which gets no points" in said
    assert f"type again: ./course submit {NAME}" in said
    assert "hand in what is in" not in said
    handed_in = tmp_path / "hand_in" / f"{NAME}.ipynb"
    assert not handed_in.exists()

    put(tmp_path, f"{NAME}.ipynb")
    command.submit([NAME])
    assert "starter" not in printed_by(capsys)
    put(tmp_path, starter)
    with pytest.raises(typer.Exit):
        command.submit([NAME])
    assert f"is not replaced: it keeps fingerprint {fingerprint(WORK)}" in printed_by(capsys)
    assert read_submission(handed_in, NAME).sources == {FIRST: WORK}


def test_without_a_release_the_notebook_tells_which_lines_of_its_starter_are_unwritten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(starter, "released", lambda _: {})  # as in a student's copy
    given = read_submission(STARTER, NAME)
    assert "in lines 19 and 26: write your code there" in what_is_to_be_written(given, STARTER)
    put(tmp_path, f"{NAME}.ipynb")
    assert not is_starter(given, tmp_path / f"{NAME}.ipynb")


def test_submit_says_that_unsaved_edits_are_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    put(tmp_path, f"{NAME}.ipynb")
    command.submit([NAME])
    assert "(later edits are not in it: save them with Ctrl+S, and submit again)" in printed_by(capsys)
    monkeypatch.setenv("JPY_PARENT_PID", "1")  # as in a cell
    put(tmp_path, f"{NAME}.ipynb", (FIRST, OTHER))  # the cell was run after the notebook was saved
    os.utime(tmp_path / FIRST, (5, 5))
    command.submit([NAME])
    said = printed_by(capsys)
    assert f"Not handed in: {FIRST}, the program of the cell that you ran last" in said
    assert said.endswith(f"save it (Ctrl+S), and type again: !course submit {NAME}")


def test_after_a_check_of_a_named_file_the_next_step_submits_that_file() -> None:
    passed = Grade(NAME, "me", "none", [CheckVerdict("check", "Title", "passed", 1, 1)])
    assert next_step(passed, file=Path("mine/a.py")) == (
        f"Next: hand it in: ./course submit {NAME} --file mine/a.py"
    )


@pytest.mark.parametrize(("is_saved", "warns"), [(True, False), (False, True)])
def test_in_a_notebook_a_self_check_judges_the_saved_notebook_after_it_had_it_saved(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture,
    is_saved: bool,
    warns: bool,
) -> None:
    monkeypatch.chdir(tmp_path)
    put(tmp_path, FIRST, (f"{NAME}.ipynb", notebook(OTHER)))

    def save() -> None:
        if is_saved:
            put(tmp_path, FIRST, f"{NAME}.ipynb")

    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    monkeypatch.setattr(module, "save_notebook", save)

    def check_with_progress(*_: object, **__: object) -> Grade:
        print("the verdicts")
        return Grade(NAME, "me", "none", [], program=fingerprint(WORK))

    monkeypatch.setattr(module, "check_with_progress", check_with_progress)
    module.self_check(NAME)
    before, _ = capsys.readouterr().out.split("the verdicts")
    assert ("saved with another program" in before) == warns

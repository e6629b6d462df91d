"""dates.yaml: when each exercise is due, what late work costs, and which student has an extension."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, time, timedelta, timezone
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any
from zoneinfo import ZoneInfo

import yaml
from nbgrader.utils import parse_utc
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, field_validator

from autograder.engine.exercise import all_names
from autograder.engine.verdict import Grade, Late
from ros_runtime.course_error import CourseError

DATES = "dates.yaml"
DAY = timedelta(days=1)
MAX_NAMED = 5  # students whose time is unknown
_END_OF_DAY = time(23, 59, 59)


def _moment(value: Any) -> Any:
    """Return the end of the day for a date without a time; any other value unchanged."""
    try:
        return datetime.combine(date.fromisoformat(value), _END_OF_DAY)
    except (TypeError, ValueError):
        return value


Moment = Annotated[datetime, BeforeValidator(_moment)]


class LateRule(BaseModel):
    """What late work costs.

    Attributes:
        grace_minutes: a submission that is late by at most this is not late.
        percent_per_day: deducted for each day that has begun, in % of the exercise's maximum.
        at_most_percent: the largest deduction, in % of the maximum.
        late_days: days that each student may be late in the whole term without a deduction.
        accepted_days: a submission that is later than this has no points; None: no limit.
    """

    model_config = ConfigDict(extra="forbid")
    grace_minutes: float = Field(default=0.0, ge=0.0)
    percent_per_day: float = Field(default=0.0, ge=0.0, le=100.0)
    at_most_percent: float = Field(default=100.0, ge=0.0, le=100.0)
    late_days: int = Field(default=0, ge=0)
    accepted_days: int | None = Field(default=None, ge=0)


class Dates(BaseModel):
    """The content of dates.yaml.

    Attributes:
        timezone: of the times in the file, such as Europe/Vienna.
        due: when each exercise is due; a date without a time means the end of that day.
        extensions: a later due time, by student and exercise.
        handed_in: when a student handed in, by student and exercise; it replaces the time that the platform gave.
    """

    model_config = ConfigDict(extra="forbid")
    timezone: str = "UTC"
    due: dict[str, Moment] = {}
    late: LateRule = LateRule()
    extensions: dict[str, dict[str, Moment]] = {}
    handed_in: dict[str, dict[str, Moment]] = {}

    @field_validator("timezone")
    @classmethod
    def _known(cls, name: str) -> str:
        try:
            ZoneInfo(name)
        except (ValueError, OSError, KeyError) as error:
            raise ValueError(f"{name!r} is not a time zone; expected a name such as Europe/Vienna") from error
        return name

    def due_time(self, student: str, exercise: str) -> datetime | None:
        """Return when this student's work is due, with the extension if there is one; None without a date."""
        moment = self.extensions.get(student, {}).get(exercise) or self.due.get(exercise)
        return self._aware(moment) if moment else None

    def is_extended(self, student: str, exercise: str) -> bool:
        """Whether this student has an extension."""
        return exercise in self.extensions.get(student, {})

    def time_of(self, student: str, exercise: str, timestamp: str) -> datetime | None:
        """Return when the work was handed in; `timestamp` is the platform's, or "". None if nobody knows."""
        if written := self.handed_in.get(student, {}).get(exercise):
            return self._aware(written)
        return parse_utc(timestamp).replace(tzinfo=timezone.utc) if timestamp else None

    def in_words(self, moment: datetime) -> str:
        """Return a time as the student's page shows it."""
        return f"{moment.astimezone(ZoneInfo(self.timezone)):%a %d %b %Y %H:%M %Z}"

    def _aware(self, moment: datetime) -> datetime:
        return moment if moment.tzinfo else moment.replace(tzinfo=ZoneInfo(self.timezone))


@dataclass(frozen=True)
class Deadlines:
    """The late rule, applied to a class. `path` is the file that it comes from."""

    path: Path
    dates: Dates

    def applied(self, grades: Sequence[Grade], timestamps: Mapping[tuple[str, str], str]) -> Sequence[Grade]:
        """Return the grades, each with what it loses for being late.

        A student's late days are used in the order in which the work was handed in, so later work never changes an
        earlier grade. Work with an unknown time loses nothing. Work in time by an extension says so.
        """
        late: dict[tuple[str, str], Late] = {}
        left: dict[str, int] = {}
        known = [
            (moment, grade)
            for grade in grades
            if (
                moment := self.dates.time_of(
                    grade.student, grade.exercise, timestamps.get((grade.student, grade.exercise), "")
                )
            )
        ]
        for moment, grade in sorted(known, key=lambda pair: (pair[0], pair[1].exercise)):
            due = self.dates.due_time(grade.student, grade.exercise)
            grace = timedelta(minutes=self.dates.late.grace_minutes)
            if due is None or moment <= due + grace:
                if due and self.dates.is_extended(grade.student, grade.exercise):
                    in_time = f"{self._in_words(grade, moment, due)}: in time."
                    late[grade.student, grade.exercise] = Late(0.0, in_time)
                continue
            has = left.setdefault(grade.student, self.dates.late.late_days)
            late[grade.student, grade.exercise], left[grade.student] = self._late(grade, moment, due, has)
        return [replace(grade, late=late.get((grade.student, grade.exercise))) for grade in grades]

    def _late(self, grade: Grade, moment: datetime, due: datetime, has: int) -> tuple[Late, int]:
        """Return what one late submission loses, and how many of `has` late days the student has left."""
        rule, days = self.dates.late, math.ceil((moment - due) / DAY)
        words = [f"{self._in_words(grade, moment, due)}: {_days(days)} late"]
        if rule.accepted_days is not None and days > rule.accepted_days:
            words.append(f"work is accepted until {_days(rule.accepted_days)} after the due time")
            return Late(float(grade.max_score), "; ".join(words) + ": no points."), has
        free = min(has, days)
        if rule.late_days:
            words.append(f"{free} of your late days used, {has - free} of {rule.late_days} left")
        percent = min(rule.at_most_percent, rule.percent_per_day * (days - free))
        points = round(grade.max_score * percent / 100, 2)
        if not points:
            return Late(0.0, "; ".join(words) + ": nothing is deducted."), has - free
        words.append(f"{_days(days - free)} × {rule.percent_per_day:g} %")
        if percent < rule.percent_per_day * (days - free):
            words.append(f"at most {rule.at_most_percent:g} %")
        cut = f"{percent:g} % of {grade.max_score} points, {points:g}, are deducted"
        floor = ", but not below 0" if grade.earned is not None and grade.earned < points else ""
        return Late(points, f"{'; '.join(words)}: {cut}{floor}."), has - free

    def _in_words(self, grade: Grade, moment: datetime, due: datetime) -> str:
        extended = " (extended)" if self.dates.is_extended(grade.student, grade.exercise) else ""
        return f"Handed in {self.dates.in_words(moment)}, due {self.dates.in_words(due)}{extended}"

    def notes(self, grades: Sequence[Grade], timestamps: Mapping[tuple[str, str], str]) -> Sequence[str]:
        """Return sentences for the instructor: late work, unknown times, and students of the file without work."""
        late = [f"{each.student} · {each.exercise}: {each.late.reason}" for each in grades if each.late]
        students = {grade.student for grade in grades}
        strangers = ", ".join(
            f"{name} (their folder may be {close[0]})"
            if (close := get_close_matches(name, students))
            else name
            for name in sorted({*self.dates.extensions, *self.dates.handed_in} - students)
        )
        return [
            *late,
            *self._without_time({(each.student, each.exercise): "" for each in grades} | dict(timestamps)),
            *([f"{self.path} names students without a submission: {strangers}"] if strangers else []),
        ]

    def lateness(self, timestamps: Mapping[tuple[str, str], str]) -> Sequence[str]:
        """Return sentences on collected submissions: how late they are, or that their time is unknown."""
        late = []
        for (student, exercise), timestamp in sorted(timestamps.items()):
            moment, due = (
                self.dates.time_of(student, exercise, timestamp),
                self.dates.due_time(student, exercise),
            )
            if moment and due and moment > due:
                days = _days(math.ceil((moment - due) / DAY))
                late.append(f"{student} · {exercise}: {days} late, {self.dates.in_words(moment)}")
        return [*late, *self._without_time(timestamps)]

    def _without_time(self, timestamps: Mapping[tuple[str, str], str]) -> Sequence[str]:
        unknown: dict[str, list[str]] = {}
        for key, timestamp in sorted(timestamps.items()):
            if self.dates.due_time(*key) and not self.dates.time_of(*key, timestamp):
                unknown.setdefault(key[1], []).append(key[0])
        return [
            f"{exercise}: time unknown, so nothing is deducted: {_named(students)}; write the times of those who were "
            f"late to handed_in in {self.path}"
            for exercise, students in unknown.items()
        ]


def _named(students: Sequence[str]) -> str:
    more = len(students) - MAX_NAMED
    return ", ".join(students[:MAX_NAMED]) + (f" and {more} more" if more > 0 else "")


def _days(count: int) -> str:
    return f"{count} day" if count == 1 else f"{count} days"


def read_deadlines(given: Path | None, beside: Path) -> Deadlines | None:
    """Read the dates of a course from `given`, or from dates.yaml in the folder around `beside`, if it exists.

    Raises:
        CourseError: the file cannot be read, or an entry is wrong.
    """
    path = given or beside.resolve().parent / DATES
    if not given and not path.exists():
        return None
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), _Strict) or {}
        dates = Dates.model_validate(content)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise CourseError(f"{path} cannot be read: {error}") from error
    except ValidationError as error:
        first = error.errors()[0]
        place = " > ".join(map(str, first["loc"])) or "the file"
        raise CourseError(f"{path}: {place}: {first['msg']}, found {first['input']!r:.80}") from error
    named = {
        *dates.due,
        *(name for each in (dates.extensions, dates.handed_in) for of in each.values() for name in of),
    }
    if unknown := sorted(named - set(all_names())):
        raise CourseError(f"{path}: there is no exercise {unknown[0]!r}; there are {', '.join(all_names())}")
    return Deadlines(path, dates)


class _Strict(yaml.BaseLoader):
    """Reads all values as text, so that student 007 keeps the zeros; refuses a key that is given twice."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        if twice := [key for key in keys if keys.count(key) > 1]:
            raise yaml.YAMLError(f"line {node.start_mark.line + 1}: {twice[0]!r} is given twice")
        return super().construct_mapping(node, deep)

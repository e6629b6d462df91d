"""JSON Schemas of each platform's format, written from the platform's documentation, not from our models."""

from __future__ import annotations

from typing import Any

TEXT, NUMBER = {"type": "string"}, {"type": "number"}
VISIBILITY = {"enum": ["visible", "hidden", "after_due_date", "after_published"]}
FORMAT = {"enum": ["text", "html", "simple_format", "md", "ansi"]}


def record(required: str, optional: dict[str, Any] | None = None, **properties: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "required": required.split(),
        "properties": {**properties, **(optional or {})},
        "additionalProperties": False,
    }


GRADESCOPE = record(
    "",
    score=NUMBER,
    execution_time=NUMBER,
    output=TEXT,
    output_format=FORMAT,
    test_output_format=FORMAT,
    test_name_format=FORMAT,
    visibility=VISIBILITY,
    stdout_visibility=VISIBILITY,
    extra_data={"type": "object"},
    tests={
        "type": "array",
        "items": record(
            "",
            score=NUMBER,
            max_score=NUMBER,
            status={"enum": ["passed", "failed"]},
            name=TEXT,
            name_format=FORMAT,
            number=TEXT,
            output=TEXT,
            output_format=FORMAT,
            tags={"type": "array", "items": TEXT},
            visibility=VISIBILITY,
            extra_data={"type": "object"},
        ),
    },
)
WHOLE, FILLED = {"type": "integer", "minimum": 0}, {"type": "string", "minLength": 1}
CLASSROOM50 = record(
    "schema classroom assignment assignment_type owner submission commit release review datetime score max-score tests",
    {
        "schema": {"const": "classroom50/result/v1"},
        "max-score": WHOLE,
        "tests": {
            "type": "array",
            "items": record(
                "test-name passed score max-score",
                {"test-name": FILLED, "max-score": WHOLE},
                passed={"type": "boolean"},
                score=WHOLE,
            ),
        },
    },
    classroom=FILLED,
    assignment=FILLED,
    assignment_type={"enum": ["individual", "group"]},
    owner=FILLED,
    submission={"type": "string", "pattern": "^submit/"},
    commit=FILLED,
    release=FILLED,
    review=FILLED,
    datetime={"type": "string", "pattern": r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$"},
    score=WHOLE,
)
SCHEMAS = {"gradescope": GRADESCOPE, "classroom50": CLASSROOM50}

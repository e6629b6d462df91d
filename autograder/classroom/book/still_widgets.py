"""Static HTML for the lab's interactive parts: the last state of a widget, and questions with folded replies."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from html import escape
from typing import Any

from lab.learning.question import Question, in_html

VIEW = "application/vnd.jupyter.widget-view+json"
STATE = "application/vnd.jupyter.widget-state+json"
VIEW_CAPTION = "The last picture of the robot in the live view"
NO_STATIC_FORM = "In the lab, there is an interactive control here."

Models = Mapping[str, Mapping[str, Any]]


def models_of(notebook: Mapping[str, Any]) -> Models:
    """Return the widgets of an executed notebook, by id."""
    return notebook["metadata"].get("widgets", {}).get(STATE, {}).get("state", {})


def still(model_id: str, models: Models) -> str:
    """Return the HTML of a widget and its children; a sentence replaces widgets without a static form."""
    model = models.get(model_id, {})
    state = model.get("state", {})
    kind = model.get("model_name", "").removesuffix("Model")
    if kind in {"HBox", "VBox"}:
        inside = "".join(still(child.removeprefix("IPY_MODEL_"), models) for child in state["children"])
        return f'<div class="still-{kind.lower()}">{inside}</div>'
    if kind == "Image":
        return _picture(model)
    if kind == "Label":
        return f"<span>{escape(state['value'])}</span>"
    if kind == "HTML":
        return f"<span>{state['value']}</span>"
    if kind == "Button":
        return f"<button disabled>{escape(state['description'])}</button>"
    if kind == "SelectionSlider":
        chosen, last = (escape(state["_options_labels"][index]) for index in (state["index"], -1))
        words = escape(state["description"])
        return f"<p><em>{words}: {chosen}. In the lab, a slider goes up to {last}.</em></p>"
    if kind == "FloatProgress":
        of = state["max"] - state["min"]
        words = escape(state["description"])
        return (
            f'<label>{words} <progress value="{state["value"] - state["min"]}" max="{of}"></progress></label>'
        )
    return f"<p><em>{NO_STATIC_FORM}</em></p>"


def _picture(model: Mapping[str, Any]) -> str:
    data = next(
        (part["data"] for part in model.get("buffers", ()) if part["path"] == ["value"]),
        "",
    )
    base64.b64decode(data, validate=True)
    kind = model["state"].get("format", "png")
    words = escape(model["state"].get("tooltip") or VIEW_CAPTION)
    return (
        f'<figure><img src="data:image/{kind};base64,{data}" alt="{words}">'
        f"<figcaption>{VIEW_CAPTION}; in the lab it moves.</figcaption></figure>"
    )


def prediction(number: int, question: Question) -> str:
    """Return a prediction's question and choices, as HTML."""
    rows = "".join(
        f"<li><b>{letter}</b> {in_html(choice.text)}</li>" for letter, choice in question.by_letter().items()
    )
    return _box(f"Prediction {number}", f"{_words(question)}<ul>{rows}</ul>")


def replies(number: int, question: Question) -> str:
    """Return the replies to a prediction, folded, as HTML."""
    return _box(f"Prediction {number}: replies", _folded(question, wrong="It went differently."))


def quiz(number: int, question: Question) -> str:
    """Return a quiz question with a folded reply to each choice, as HTML."""
    return _box(f"Question {number}", _words(question) + _folded(question, wrong="Not this one."))


def _words(question: Question) -> str:
    return f"<p>{in_html(question.text)}</p>"


def _folded(question: Question, wrong: str) -> str:
    return "".join(
        f"<details><summary><b>{letter}</b> {in_html(choice.text)}</summary>"
        f"<p>{'Right.' if choice.right else wrong} {in_html(choice.why)}</p></details>"
        for letter, choice in question.by_letter().items()
    )


def _box(title: str, content: str) -> str:
    return f'<div class="question"><p><b>{title}</b></p>{content}</div>'

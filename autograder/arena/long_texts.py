"""Cuts texts and lists from untrusted processes to what a transcript can hold, and notes how long they were."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

MAX_LENGTH = 10_000  # characters of a text, elements of a list


@dataclass
class Longest:
    """The length of the longest text or list met, in characters or elements."""

    length: int = 0
    limit: int = MAX_LENGTH

    @property
    def was_cut(self) -> bool:
        """Whether anything was cut."""
        return self.length > self.limit


def cut_long_texts(fields: dict[str, Any]) -> tuple[dict[str, Any], Longest]:
    """Return the fields with each text and list cut to `MAX_LENGTH`, and how long the longest was."""
    longest = Longest()
    return {name: _cut(value, longest) for name, value in fields.items()}, longest


def _cut(value: Any, longest: Longest) -> Any:
    if isinstance(value, str):
        return _cut_text(value, longest)
    if isinstance(value, dict):
        return {name: _cut(each, longest) for name, each in value.items()}
    if isinstance(value, list | tuple):
        longest.length = max(longest.length, len(value))
        if len(value) > MAX_LENGTH:
            return []  # empty, because a marker of another type would not fit the field
        return [_cut(each, longest) for each in value]
    return value


def _cut_text(text: str, longest: Longest) -> str:
    longest.length = max(longest.length, len(text))
    if len(text) > MAX_LENGTH:
        text = f"{text[:MAX_LENGTH]}…[cut: {len(text):,} characters]"
    # JSON parsers refuse an unpaired surrogate
    return text if text.isascii() else text.encode(errors="replace").decode()

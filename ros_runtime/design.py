"""A student's written design of a system: nodes, and facts about each link between two of them.

    camera -> part_finder : topic sensor_msgs/msg/Image
        qos: best effort, keep last 1
        rate: 15 Hz
        failure: after 0.5 s without a picture part_finder says so,
            and finds nothing more
        safety: it moves nothing

Left of the arrow is the node that publishes, or that sends the request or goal. `#` begins a comment. A line with
deeper indentation continues the one above. Only the presence of each fact is checked, not whether it is right.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

# The middle part of the type names of each pattern: sensor_msgs/msg/Image.
KINDS: Mapping[str, str] = {"topic": "msg", "service": "srv", "action": "action"}
WIRE = "wire"  # a link without ROS, such as a cable or a fieldbus
PATTERNS = (*KINDS, WIRE)
FACTS = ("qos", "rate", "failure", "safety")  # in addition to pattern and type, which are in the first line
FIELDS = "fields"  # optional, for the fields of a type that the student defines
EXAMPLE = "camera -> part_finder : topic sensor_msgs/msg/Image"

_LINK = re.compile(r"(?P<sender>\w+)\s*->\s*(?P<receiver>\w+)\s*:\s*(?P<pattern>\w+)\b\s*(?P<type>.*)")
_TYPE = re.compile(r"[a-z]\w*/(?:(?P<kind>\w+)/)?[A-Z]\w*")
_FACT = re.compile(r"(?P<name>\w+)\s*:(?P<text>.*)")


@dataclass(frozen=True)
class Link:
    """A connection between two nodes; `facts` maps names in FACTS and FIELDS to their texts."""

    sender: str
    receiver: str
    pattern: str
    type: str
    facts: Mapping[str, str] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.sender} -> {self.receiver}"

    def missing(self) -> list[str]:
        """Return a sentence about each of the six facts that is missing or cannot be read."""
        found = [self._about_pattern(), self._about_type()]
        wanted = [fact for fact in FACTS if not (fact == "qos" and self.pattern == WIRE)]
        found += [f"{fact} is missing" for fact in wanted if not _has_words(self.facts.get(fact, ""))]
        return [sentence for sentence in found if sentence]

    def _about_pattern(self) -> str:
        if self.pattern in PATTERNS:
            return ""
        return f"pattern: expected one of {', '.join(PATTERNS)}, got {self.pattern!r}"

    def _about_type(self) -> str:
        if self.pattern not in KINDS:
            return "" if _has_words(self.type) else "type is missing: say what the wire carries"
        kind = KINDS[self.pattern]
        named = _TYPE.fullmatch(self.type)
        if named and named["kind"] in (None, kind):
            return ""
        return f"type: expected the full name PACKAGE/{kind}/NAME after {self.pattern!r}, got {self.type!r}"


@dataclass(frozen=True)
class Design:
    """The links in the order of the text, and a sentence for each line that could not be read."""

    links: tuple[Link, ...]
    problems: tuple[str, ...] = ()

    @property
    def nodes(self) -> tuple[str, ...]:
        """The nodes, in the order in which they first appear."""
        return tuple(dict.fromkeys(node for link in self.links for node in (link.sender, link.receiver)))


def read_design(text: str) -> Design:
    """Read a design; raises nothing, since unreadable lines become `problems`."""
    reader = _Reader()
    for number, line in enumerate(text.splitlines(), start=1):
        reader.take(number, line)
    return Design(tuple(reader.links), tuple(reader.problems))


class _Reader:
    """The links parsed so far, and the open section of the last one."""

    def __init__(self) -> None:
        self.links: list[Link] = []
        self.problems: list[str] = []
        self._facts: dict[str, str] | None = None  # of the last link; None after an unreadable link
        self._indent = 0  # of the last link's facts
        self._fact = ""  # name of the last fact

    def take(self, number: int, line: str) -> None:
        words = line.partition("#")[0].strip()
        if not words:
            return
        indent = len(line) - len(line.lstrip())
        if indent == 0:
            self._begin_link(number, words)
        elif self._facts is not None:
            self._continue_link(number, words, indent)

    def _begin_link(self, number: int, words: str) -> None:
        found = _LINK.fullmatch(words)
        self._facts, self._indent, self._fact = ({} if found else None), 0, ""
        if found is None or self._facts is None:
            self.problems.append(f"line {number}: expected a link such as {EXAMPLE!r}, got {words!r}")
            return
        pattern = found["pattern"].lower()
        self.links.append(
            Link(found["sender"], found["receiver"], pattern, found["type"].strip(), self._facts)
        )

    def _continue_link(self, number: int, words: str, indent: int) -> None:
        assert self._facts is not None
        self._indent = self._indent or indent
        if self._fact and indent > self._indent:
            self._facts[self._fact] += f" {words}"
            return
        found = _FACT.fullmatch(words)
        name = found["name"].lower() if found else ""
        if found is None or name not in (*FACTS, FIELDS):
            names = ", ".join((*FACTS, FIELDS))
            self.problems.append(
                f"line {number}: expected one of {names} and a colon, got {words!r}; indent it further if it belongs "
                "to the line above"
            )
            return
        if name in self._facts:
            self.problems.append(f"line {number}: {self.links[-1]} already has {name}")
            return
        self._fact = name
        self._facts[name] = found["text"].strip()


def _has_words(text: str) -> bool:
    return any(character.isalnum() for character in text)

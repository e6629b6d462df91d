"""The message types that a definition can use: those of the installed packages."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class KnownTypes:
    """Names of messages by package."""

    packages: Mapping[str, frozenset[str]]

    @classmethod
    def installed(cls, prefixes: Sequence[Path]) -> KnownTypes:
        """Return the types in share/<package>/msg of the prefixes."""
        found: dict[str, frozenset[str]] = {}
        for folder in (folder for prefix in reversed(prefixes) for folder in prefix.glob("share/*/msg")):
            found[folder.parent.name] = frozenset(path.stem for path in folder.glob("*.msg"))
        return cls(found)

    def with_package(self, package: str, messages: Collection[str]) -> KnownTypes:
        """Return these types and those of one more package."""
        return KnownTypes({**self.packages, package: frozenset(messages)})

    def has(self, package: str, message: str) -> bool:
        """Return whether there is such a message."""
        return message in self.packages.get(package, ())

    def packages_with(self, message: str) -> list[str]:
        """Return the packages that have a message of this name."""
        return sorted(package for package, messages in self.packages.items() if message in messages)

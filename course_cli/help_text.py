"""How the help and the error messages of all commands look."""

from __future__ import annotations

import re
from typing import Any

from typer import rich_utils
from typer.core import TyperArgument, TyperOption

from autograder.report.console import BAD

# Rich's names of the styles that Typer colours in yellow, cyan, dark red or dim blue, which only one background suits.
BOLD = (
    *("STYLE_OPTION", "STYLE_SWITCH", "STYLE_NEGATIVE_OPTION", "STYLE_NEGATIVE_SWITCH", "STYLE_USAGE"),
    *("STYLE_COMMANDS_TABLE_FIRST_COLUMN", "STYLE_REQUIRED_SHORT", "STYLE_REQUIRED_LONG"),
)
PLAIN = (
    *("STYLE_TYPES", "STYLE_TYPES_SEPARATOR", "STYLE_HELPTEXT", "STYLE_ERRORS_SUGGESTION"),
    *("STYLE_OPTION_DEFAULT", "STYLE_OPTION_ENVVAR"),
)
ERRORS = ("STYLE_ERRORS_PANEL_BORDER", "STYLE_ABORTED")
TYPE_WORDS = {"str": "TEXT", "path": "PATH", "int": "NUMBER", "int range": "NUMBER", "float": "NUMBER"}


def make_readable() -> None:
    """Give Typer's help styles that can be read on white and on black, and words for the types of options."""
    for names, style in ((BOLD, "bold"), (PLAIN, ""), (ERRORS, BAD)):
        for name in names:
            setattr(rich_utils, name, style)
    rich_utils.RICH_HELP = "Try '{command_path} {help_option}' for help."
    if hasattr(TyperOption, "display_type_rich"):  # since Typer 0.27
        TyperOption.display_type_rich = _type_in_words  # type: ignore[assignment, method-assign]
        TyperArgument.display_type_rich = lambda *_, **__: None  # type: ignore[method-assign]
        TyperArgument.get_usage_pieces = _usage  # type: ignore[assignment, method-assign]


def paragraphs(docstring: str | None) -> str:
    """Return a docstring with one line for each paragraph, which the terminal's width breaks."""
    return "\n\n".join(" ".join(each.split()) for each in re.split(r"\n\s*\n", docstring or ""))


def _type_in_words(option: TyperOption, ctx: Any) -> str | None:
    """Return what an option takes: its metavar, its choices or a word for its type; None for a flag."""
    if option.metavar is not None:
        return option.metavar
    kind = option.display_type(ctx).strip("<>").removeprefix("list[").removesuffix("]")
    return None if kind == "bool" else TYPE_WORDS.get(kind, kind)


def _usage(argument: TyperArgument, _: Any) -> list[str]:
    """Return an argument in the line "Usage": EXERCISE, or [FILE] if it may be left out."""
    name = (argument.metavar or argument.name).upper() + ("..." if argument.nargs != 1 else "")
    return [name if argument.required else f"[{name}]"]

"""Decodes a student's file as Python does (PEP 263), and recognizes common files that are not programs."""

from __future__ import annotations

import codecs
import io
import re
import tokenize

LONGEST_QUOTE = 100  # characters of Python's error message
_ASCII = "".join(map(chr, range(32, 127))) + "\n"
_UTF_8 = "save it as UTF-8, which editors offer in “Save with encoding”, and hand it in again"
_BINARY = "hand in the text file that you wrote"
# first bytes of a file; the end of the error message: what it is, what to do
_WHAT_BYTES_ARE: tuple[tuple[bytes, str], ...] = (
    (codecs.BOM_UTF32_LE, f"is UTF-32 text, and Python reads UTF-8: {_UTF_8}"),
    *(
        (
            bom,
            f"is UTF-16 text, as PowerShell and Notepad's “Unicode” write it, and Python reads UTF-8: {_UTF_8}",
        )
        for bom in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
    ),
    (b"PK\3\4", f"is a zip archive or an office document: {_BINARY}"),
    (b"\x1f\x8b", f"is compressed by gzip: {_BINARY}"),
    (
        b"version https://git-lfs",
        "is only a git-lfs pointer: type `git lfs pull`, and hand in the file itself",
    ),
    (b"%PDF", f"is a PDF: {_BINARY}"),
    (b"\x89PNG", f"is a picture: {_BINARY}"),
    (b"{\\rtf", "is a word processor's document (RTF): save it as plain text, and hand it in again"),
)
_MERGE = ("\n<<<<<<< ", "\n=======\n", "\n>>>>>>> ")  # git's conflict markers
_THE_NOTEBOOK = "hand in the notebook itself, the .ipynb file, or the file that its %%writefile cell writes"
# a pattern that no Python program matches; the end of the error message
_WHAT_TEXT_IS: tuple[tuple[str, str], ...] = (
    (
        r"\A\s*\{(?=[\s\S]*\"cells\")(?=[\s\S]*\"nbformat\")",
        "is a notebook: give it a name that ends in .ipynb",
    ),
    (
        r"^get_ipython\(\)\.(run_cell_magic|run_line_magic|system|getoutput|magic)\(",
        f"is a notebook that was exported as a script, and only a notebook has get_ipython(): {_THE_NOTEBOOK}",
    ),
    (
        r"\A(?![\s\S]*^[ \t]*(async[ \t]+def|def|class)[ \t])[\s\S]*^# ?%%writefile ",
        f"is a notebook that was exported as a script, with its program in comments: {_THE_NOTEBOOK}",
    ),
    (r"\A\s*%%(writefile|file)\b", "begins with %%writefile, a line of a notebook's cell: delete that line"),
    (
        r"\A\s*<(!doctype html|html)\b",
        "is a web page: download the file itself (on GitHub, “Download raw file”)",
    ),
    (r"\A\s*```", "begins with ```, which marks code in a chat and is no Python: delete those lines"),
)


class NoProgram(ValueError):
    """The file is no program; the message says what it is and what to do, without the file's name."""


def text_of(name: str, content: bytes) -> str:
    """Return the text of the file `name`, in the encoding that a .py file declares, else in UTF-8.

    Raises:
        NoProgram: it is not text, or not a program.
    """
    if what := next((what for sign, what in _WHAT_BYTES_ARE if content.startswith(sign)), None):
        raise NoProgram(what)
    if nulls := content.count(0):
        is_text = nulls > len(content) // 3  # UTF-16 has a null byte in every Latin letter
        raise NoProgram(
            f"is UTF-16 text, and Python reads UTF-8: {_UTF_8}" if is_text else f"is no text: {_BINARY}"
        )
    encoding = _declared(content) if name.endswith(".py") else "utf-8-sig"
    try:
        text = io.TextIOWrapper(io.BytesIO(content), encoding).read()
    except UnicodeError as error:
        line = content.count(b"\n", 0, getattr(error, "start", 0)) + 1
        raise NoProgram(
            f"is not {encoding.removesuffix('-sig').upper()} text in line {line}: {_UTF_8}"
        ) from error
    if all(mark in f"\n{text}" for mark in _MERGE):
        raise NoProgram(
            "has a merge conflict between <<<<<<< and >>>>>>>: keep one of the two versions, and delete the markers"
        )
    if name.endswith((".py", ".ipynb")) and not text.strip():
        raise NoProgram("is empty: save your work, and hand it in again")
    if name.endswith(".py"):
        for sign, what in _WHAT_TEXT_IS:
            if re.search(sign, text, re.MULTILINE | re.IGNORECASE):
                raise NoProgram(what)
    return text


def bytes_of(name: str, text: str) -> bytes:
    """Return the content of the file `name`, given the text from `text_of`, in the encoding that it declares."""
    content = text.encode()
    return text.encode(_declared(content)) if name.endswith(".py") else content


def _declared(content: bytes) -> str:
    """Return the encoding that a program declares, 'utf-8' if none."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(content).readline)
        if encoding == "utf-8-sig" or _ASCII.encode(encoding) == _ASCII.encode():
            return encoding
        reason = f"Python cannot read programs in {encoding}"
    except (SyntaxError, LookupError, UnicodeError) as error:
        reason = str(error)[:LONGEST_QUOTE]
    raise NoProgram(f"cannot be read as Python reads it ({reason}): {_UTF_8}")

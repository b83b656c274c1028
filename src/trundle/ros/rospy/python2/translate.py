"""Translates Python 2 source to Python 3, in memory."""

import ast
import difflib
import logging
import re
import warnings
from functools import cache
from types import CodeType
from typing import Any

from .semantics import keep_semantics

_FIXERS = """apply dict except exec funcattrs getcwdu has_key imports imports2 itertools
    itertools_imports metaclass methodattrs ne next nonzero numliterals paren print raise renames repr sys_exc throw
    tuple_params urllib xreadlines"""
_RELATIVE_IMPORTS = "import"
_DIVISION = re.compile(r"^from\s+__future__\s+import\s.*\bdivision\b", re.MULTILINE)
_INDENT = re.compile(r"^[ \t]+", re.MULTILINE)


def translate(source: str, filename: str, *, in_package: bool = False) -> str:
    """Translate Python 2 to Python 3, which uses the helpers of `names`.

    Args:
        source: text of the file.
        filename: file's path, in whose folder modules are searched.
        in_package: True for a module of a package, where `import name` may import a module of its folder.

    Raises:
        SyntaxError: the source is neither Python 2 nor Python 3.
    """
    text = source.replace("\r\n", "\n").replace("\r", "\n")
    if "\t" in text:
        text = _INDENT.sub(lambda match: match[0].expandtabs(8), text)  # Python 2 allows mixed tabs and spaces
    text = text if text.endswith("\n") else text + "\n"
    tree = _parse(text, filename, in_package)
    return keep_semantics(str(tree), true_division=bool(_DIVISION.search(text)))


def compile_translated(source: str, filename: str, *, in_package: bool) -> CodeType:
    """Compile Python 2 source, see `translate`; its code has the line numbers of `source`."""
    text = translate(source, filename, in_package=in_package)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SyntaxWarning)
        warnings.simplefilter("ignore", DeprecationWarning)
        tree = ast.parse(text, filename)
        _renumber(tree, _line_numbers(source, text))
        return compile(tree, filename, "exec", dont_inherit=True)


def show_changes(source: str, filename: str) -> str:
    """Unified diff of the translation."""
    new = translate(source, filename)
    names = filename, f"{filename} (translated)"
    return "\n".join(difflib.unified_diff(source.splitlines(), new.splitlines(), *names, lineterm=""))


def _parse(text: str, filename: str, in_package: bool) -> "Any":
    from fissix.pgen2.parse import ParseError
    from fissix.pgen2.tokenize import TokenError

    failed: Exception | None = None
    for print_function in (False, True):
        try:
            return _tool(print_function, in_package).refactor_string(text, filename)
        except (ParseError, TokenError, IndentationError) as error:
            failed = failed or error
    try:
        compile(text, filename, "exec", dont_inherit=True)
    except SyntaxError as error:
        raise error from None
    raise SyntaxError(f"{filename}: neither Python 2 nor Python 3: {failed}")


@cache
def _tool(print_function: bool, in_package: bool) -> "Any":
    logging.getLogger("fissix").setLevel(logging.CRITICAL)
    logging.getLogger("RefactoringTool").setLevel(logging.CRITICAL)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from fissix.refactor import RefactoringTool

        names = [*_FIXERS.split(), *([_RELATIVE_IMPORTS] if in_package else [])]
        return RefactoringTool([f"fissix.fixes.fix_{name}" for name in names], {"print_function": print_function})


def _line_numbers(source: str, text: str) -> list[int]:
    """Line of `source` for every line of `text`, from 1."""
    old, new = source.splitlines(), text.splitlines()
    if len(old) == len(new):
        return list(range(len(new) + 2))
    lines = [0] * (len(new) + 2)
    for _, start, end, first, last in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        for line in range(first, last):
            lines[line + 1] = min(start + (line - first), max(end - 1, start)) + 1
    lines[-1] = len(old)
    return lines


def _renumber(tree: ast.AST, lines: list[int]) -> None:
    """Set the nodes' line numbers, and unset the columns, which would be those of the translated text."""
    for node in ast.walk(tree):
        if isinstance(node, ast.expr | ast.stmt | ast.excepthandler | ast.arg | ast.keyword | ast.alias):
            node.lineno = lines[node.lineno]
            node.end_lineno = max(node.lineno, lines[node.end_lineno or 1])
            node.col_offset = node.end_col_offset = -1

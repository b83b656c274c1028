"""Python 2's semantics of syntax that both versions have: `/`, exceptions that are strings, `__div__`."""

import re
from functools import cache
from itertools import pairwise
from typing import Any

_METHODS = {"__div__": "__truediv__", "__rdiv__": "__rtruediv__", "__idiv__": "__itruediv__"}
_FLOAT = re.compile(r"(?:\d+\.\d*|\.\d+)(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+")
_SIMPLE = frozenset(" .[]'\"_")


def keep_semantics(text: str, *, true_division: bool) -> str:
    """Rewrite code in Python 3's syntax so that it keeps Python 2's semantics.

    Args:
        text: code in Python 3's syntax.
        true_division: True if the file imports `division`; `/` stays unchanged.
    """
    driver, names = _driver()
    tree = driver.parse_string(text)
    for node in list(tree.post_order()):
        kind = names.get(node.type)
        if kind == "term" and not true_division:
            _replace_division(node)
        elif kind == "expr_stmt" and not true_division:
            _replace_augmented_division(node)
        elif kind == "power":
            _sort_by_key(node)
        elif kind in ("raise_stmt", "except_clause"):
            _name_string_exception(node)
        elif kind is None and getattr(node, "value", None) in _METHODS:
            node.value = _METHODS[node.value]
    return str(tree)


@cache
def _driver() -> tuple[Any, dict[int, str]]:
    from fissix import pygram, pytree
    from fissix.pgen2.driver import Driver

    driver = Driver(pygram.python_grammar_no_print_and_exec_statement, convert=pytree.convert)
    return driver, dict(pygram.python_grammar.number2symbol)


def _leaf(text: str, prefix: str) -> Any:
    from fissix.pgen2 import token
    from fissix.pytree import Leaf

    return Leaf(token.NAME, text, prefix=prefix)


def _replace_division(node: Any) -> None:
    """`a * b / c % d` → `python2_divide(a * b, c) % d`; divisions by or of a float literal stay."""
    first, *rest = node.children
    prefix, text, changed = node.prefix, str(first)[len(node.prefix) :], False
    for sign, right in zip(rest[::2], rest[1::2], strict=True):
        if sign.value == "/" and not _is_float(text) and not _is_float(str(right)):
            gap = sign.prefix if "\n" in sign.prefix else ""
            text = f"python2_divide({text}{gap},{right.prefix or ' '}{str(right)[len(right.prefix) :]})"
            changed = True
        else:
            text += f"{sign}{right}"
    if changed:
        node.replace(_leaf(text, prefix))


def _replace_augmented_division(node: Any) -> None:
    """`a /= b` → `a = python2_divide_in_place(a, b)`; the target's object and index are evaluated once."""
    if len(node.children) != 3 or getattr(node.children[1], "value", "") != "/=":
        return
    target, value = str(node.children[0]).strip(), str(node.children[2]).strip()
    if all(character.isalnum() or character in _SIMPLE for character in target):
        text = f"{target} = python2_divide_in_place({target}, {value})"
    else:
        text = f"{target} /= python2_divisor({value})"
    node.replace(_leaf(text, node.prefix))


def _sort_by_key(node: Any) -> None:
    """`.sort(f)` and `.sort(cmp=f)` → `.sort(key=python2_cmp_to_key(f))`; a number is an axis of numpy's."""
    for name, call in pairwise(node.children):
        if str(name) != ".sort" or len(getattr(call, "children", ())) != 3:
            continue
        text = str(call.children[1]).removeprefix("cmp=")
        is_keyword = "=" in text and not text.startswith("lambda")
        if not is_keyword and "," not in text.partition("lambda")[0] and not text.strip("-").isdigit():
            call.children[1].replace(_leaf(f"key=python2_cmp_to_key({text})", ""))


def _is_float(text: str) -> bool:
    return _FLOAT.fullmatch(text.strip()) is not None


def _name_string_exception(node: Any) -> None:
    """`raise "text"` and `except "text"` → a class of that name."""
    if len(node.children) < 2 or not str(node.children[1]).lstrip().startswith(('"', "'")):
        return
    text, values = node.children[1], [str(child).strip() for child in node.children[3::2]]
    call = f"python2_string_exception({str(text).strip()})"
    if node.children[0].value == "raise":
        node.replace(_leaf(f"raise {call}({', '.join(values[:1])})", node.prefix))
    else:
        text.replace(_leaf(call, text.prefix))

"""Known escapes from Python sandboxes: all are refused with a message, and none runs code."""

from typing import Any

import pytest
from tests.base.expressions.names import evaluate

from trundle.base.expressions import ExpressionError, Function, wrap_function

_NO_SUCH_NAME = "is not defined"
_NO_ATTRIBUTE = "has no attribute"
_HIDDEN = "Use of invalid name"
_FIELD = "a field is a whole value"
_SYNTAX = (
    "is not allowed in an expression|cannot be set in an expression|invalid syntax|cannot assign|can't use|outside"
)
_NOT_CALLABLE = "is not callable"
_BUILTINS = """
    eval exec compile open input getattr setattr hasattr vars dir globals locals super breakpoint memoryview bytearray
    object callable iter next id print exit help property classmethod
"""
ATTACKS = [
    # A generator's frame leads to the builtins.
    (
        "(lambda h: [h.append((h[0].gi_frame.f_back.f_back.f_back.f_builtins for _ in [1])), "
        "list(h[0])[0]['import']('os').system('id')][1])([])",
        _NO_ATTRIBUTE,
    ),
    ("(x for x in [1]).gi_frame", _NO_ATTRIBUTE),
    ("(x for x in [1]).gi_code", _NO_ATTRIBUTE),
    ("(x for x in [1]).send", _NO_ATTRIBUTE),
    ("map(str, [1]).gi_frame", _NO_ATTRIBUTE),
    ("(lambda: 1).func_globals", _NO_ATTRIBUTE),
    ("(lambda: 1).call", _NO_ATTRIBUTE),
    ("(lambda: 1)._running", _NO_ATTRIBUTE),
    ("'a'.upper.owner", _NO_ATTRIBUTE),
    ("'a'.upper.guard", _NO_ATTRIBUTE),
    ("offered.body", _NO_ATTRIBUTE),
    ("sin.real", _NO_ATTRIBUTE),
    ("error.tb_frame", _NO_ATTRIBUTE),
    ("error.with_traceback", _NO_ATTRIBUTE),
    ("error.args", _NO_ATTRIBUTE),
    ("plain.secret", _NO_ATTRIBUTE),
    # Names with underscores, written in any way; PEP 3131 normalizes letters of other alphabets.
    *(
        (text, _HIDDEN)
        for text in (
            "().__class__",
            "().__class__.__bases__[0].__subclasses__()",
            "''.__class__.__mro__",
            "[].__getattribute__('append')",
            "str.__subclasses__()",
            "__import__('os')",
            "__builtins__",
            "sin.__self__",
            "(lambda: 1).__globals__",
            "(lambda: 1).__code__",
            "error.__traceback__",
            "().__cl\uff41ss__",
            "()._\uff3fclass\uff3f_",
            "_\uff3fimport\uff3f_('os')",
            "[__x for __x in [1]]",
            "(lambda __x: 1)(1)",
        )
    ),
    # Builtins that no file needs.
    *(
        (f"{name}(1)", _NO_SUCH_NAME)
        for name in [
            "eval",
            "exec",
            "compile",
            "open",
            "input",
            "getattr",
            "setattr",
            "hasattr",
            "vars",
            "dir",
            "globals",
            "locals",
            "super",
            "breakpoint",
            "memoryview",
            "bytearray",
            "object",
            "callable",
            "iter",
            "next",
            "id",
            "print",
            "exit",
            "help",
            "property",
            "classmethod",
        ]
    ),
    # Types.
    ("type('X', (), {})", r"type\(\) takes 1"),
    ("type('X', (list,), {'append': print})", "is not defined"),
    ("type(lambda: 1)(1)", _NOT_CALLABLE),
    ("type(x for x in [])()", _NOT_CALLABLE),
    ("type(type)(1)", None),
    ("type(offered)('a', lambda: 1)", _NOT_CALLABLE),
    ("type(sin)", None),
    ("type(plain)()", _NOT_CALLABLE),
    ("plain()", _NOT_CALLABLE),
    ("list[int]", "not subscriptable"),
    ("type(1).from_bytes", _NO_ATTRIBUTE),
    ("str.mro()", _NO_ATTRIBUTE),
    ("dict.fromkeys", _NO_ATTRIBUTE),
    # Formats reach into values.
    ("'{0.gi_frame}'.format(x for x in [1])", _FIELD),
    ("'{0.real}'.format(1)", _FIELD),
    ("'{0[0]}'.format([1])", _FIELD),
    ("'{.real}'.format(1)", _FIELD),
    ("'{[0]}'.format([1])", _FIELD),
    ("'{a.real}'.format(a=1)", _FIELD),
    ("'{a.real}'.format_map({'a': 1})", _FIELD),
    ("'{:{0.real}}'.format(1)", "a field is a whole value|cannot switch"),
    ("'{0:{0.real}}'.format(1)", _FIELD),
    ("str.format('{0.real}', 1)", _FIELD),
    ("list(map(str.format, ['{0.real}'], [1]))", _FIELD),
    ("list(map('{0.real}'.format, [1]))", _FIELD),
    ("(lambda f: f('{0.real}', 1))(str.format)", _FIELD),
    ("f'{(x for x in [1]).gi_frame}'", _NO_ATTRIBUTE),
    ("f'{plain:secret}'", "unsupported format string"),
    ("'%(a.real)s' % {'a': 1}", "a.real"),
    # Syntax.
    ("(x := 1)", _SYNTAX),
    ("[y := 1, y]", _SYNTAX),
    ("[x for x.real in [1]]", _SYNTAX),
    ("[x for x[0] in [1]]", _SYNTAX),
    ("[x async for x in []]", "async"),
    ("(yield 1)", _SYNTAX),
    ("(await x)", _SYNTAX),
    ("import os", _SYNTAX),
    ("1; 2", _SYNTAX),
    ("b'bytes'", _SYNTAX),
    ("...", _SYNTAX),
    ("[1] @ [2]", "matrices"),
    ("lambda x=().__class__: x", _HIDDEN),
    ("(lambda x=(y for y in [1]).gi_frame: x)()", _NO_ATTRIBUTE),
    # Methods that are values, and methods of other objects than their own.
    ("str.upper(1)", "needs a str first"),
    ("list.append('a', 1)", "needs a list first"),
    ("'a'.encode('idna')", _NO_ATTRIBUTE),
    ("sorted([1], cmp=1)", "invalid keyword"),
    ("sorted([(lambda: 1).gi_frame])", _NO_ATTRIBUTE),
    ("str(b'x', 'utf-8')", _SYNTAX),
    ("str(1, 'utf-8')", "takes one value"),
]


class Plain:
    """Object of any other class."""

    secret = "secret"

    def __call__(self) -> str:
        return self.secret


@pytest.mark.parametrize(("text", "words"), ATTACKS, ids=[text for text, _ in ATTACKS])
def test_sandbox_escapes_are_refused(text: str, words: str | None) -> None:
    names: dict[str, Any] = {"plain": Plain(), "error": ValueError("x"), "offered": wrap_function(len, "offered")}
    if words is None:
        assert isinstance(evaluate(text, **names), type)
        return
    with pytest.raises(
        (ExpressionError, NameError, TypeError, AttributeError, SyntaxError, ValueError, KeyError), match=words
    ):
        evaluate(text, **names)


class Shouting(str):
    """Subclass of str."""

    __slots__ = ()

    def reach(self) -> str:
        return "out"


def test_a_str_subclass_has_only_str_methods() -> None:
    assert evaluate("shout.upper()", shout=Shouting("a")) == "A"
    with pytest.raises(AttributeError, match="no attribute 'reach' that an expression may use"):
        evaluate("shout.reach()", shout=Shouting("a"))


def test_wrapped_functions_are_called_with_the_arguments() -> None:
    calls: list[object] = []
    offered = wrap_function(lambda *values, **named: calls.append((values, named)), "offered")

    assert repr(offered) == "<function offered>"
    assert evaluate("offered(1, a=[2])", offered=offered) is None
    assert calls == [((1,), {"a": [2]})]


def test_unwrapped_functions_are_not_called() -> None:
    called: list[object] = []
    with pytest.raises(TypeError, match="'builtin_function_or_method' object is not callable for an expression"):
        evaluate("function(1)", function=called.append)
    assert called == []
    assert isinstance(wrap_function(len), Function)


@pytest.mark.parametrize("text", [r"'\ud800'", "'%c' % 55296", "'{:c}'.format(55296)", r"['a', '\udfff'][1]"])
def test_lone_surrogates_are_refused(text: str) -> None:
    with pytest.raises(ExpressionError, match="half of a surrogate pair"):
        evaluate(text)


def test_unicode_escapes_are_text() -> None:
    assert evaluate(r"'\u00e9' + '\U0001f916'") == "é🤖"

"""Reader of configurations in Lua: tables, assignments and arithmetic; no functions, conditions or loops."""

import math
import re
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from trundle.base.diagnostics import UsageError

LuaValue: TypeAlias = "float | bool | str | dict[str | int, LuaValue] | None"
LuaTable: TypeAlias = "dict[str | int, LuaValue]"

_MAX_DEPTH = 50
_MAX_TEXT = 100_000
"""Length of a text that is joined."""
_TOKEN = re.compile(
    r"""(?P<space>\s+|--\[\[.*?\]\]|--[^\n]*)
    |(?P<number>0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    |(?P<name>[A-Za-z_]\w*)
    |(?P<text>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
    |(?P<sign>\.\.|[-+*/^(){}\[\]=,;.])""",
    re.VERBOSE | re.DOTALL,
)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "rad": math.radians,
    "deg": math.degrees,
    "sqrt": math.sqrt,
    "abs": abs,
    "floor": math.floor,
    "sin": math.sin,
    "cos": math.cos,
}
_PRECEDENCE = {"..": 1, "+": 2, "-": 2, "*": 3, "/": 3, "^": 5}
_UNARY = 4


class LuaError(UsageError):
    """What cannot be read, with file and line."""


class _Token(NamedTuple):
    kind: str
    text: str
    at: int


class LuaReader:
    """Values of one program, with what its includes define."""

    def __init__(self, include: "Callable[[LuaReader, str], None]") -> None:
        """Start without variables; `include` runs another file in this reader."""
        self._include = include
        self.values: LuaTable = {"math": {"pi": math.pi, "huge": math.inf}}
        """Global variables."""
        self.assigned: list[str] = []
        """Variables that were assigned, such as `POSE_GRAPH.constraint_builder.min_score`."""

    def run(self, text: str, file: str) -> LuaValue:
        """Read a file; return what it returns.

        Raises:
            LuaError: it is not of the part of Lua that is read.
        """
        return _Parser(text, file, self).chunk()

    def include(self, name: str) -> None:
        """Run another file."""
        self._include(self, name)


class _Parser:
    def __init__(self, text: str, file: str, reader: LuaReader) -> None:
        self._text = text
        self._file = file
        self._reader = reader
        self._depth = 0
        self._place = 0
        self._tokens = self._split()

    def _split(self) -> list[_Token]:
        tokens: list[_Token] = []
        place = 0
        while place < len(self._text):
            match = _TOKEN.match(self._text, place)
            if match is None:
                raise self._error(f"{self._text[place : place + 10]!r} is not understood", place)
            kind = match.lastgroup or ""
            if kind != "space":
                tokens.append(_Token(kind, match[0], place))
            place = match.end()
        tokens.append(_Token("end", "the end of the file", place))
        return tokens

    def _error(self, what: str, at: int | None = None) -> LuaError:
        place = self._tokens[self._place].at if at is None else at
        return LuaError(f"{self._file}:{self._text.count(chr(10), 0, place) + 1}: {what}")

    @property
    def _next(self) -> str:
        return self._tokens[self._place].text

    def _take(self, *expected: str) -> str:
        """Return the next token; one of those expected, if any are."""
        token = self._next
        if expected and token not in expected:
            raise self._error(f"expected {' or '.join(expected)}, got {token}")
        self._place += 1
        return token

    def _name(self) -> str:
        if self._tokens[self._place].kind != "name":
            raise self._error(f"expected a name, got {self._next}")
        return self._take()

    # -- statements

    def chunk(self) -> LuaValue:
        """Run all statements."""
        while self._tokens[self._place].kind != "end":
            if self._next == ";":
                self._take()
            elif self._next == "return":
                self._take()
                return self._expression()
            elif self._next == "include":
                self._take()
                self._reader.include(self._included())
            else:
                self._assignment()
        return None

    def _included(self) -> str:
        has_parenthesis = self._next == "("
        if has_parenthesis:
            self._take()
        if self._tokens[self._place].kind != "text":
            raise self._error(f"expected a file's name in quotes, got {self._next}")
        name = self._string(self._take())
        if has_parenthesis:
            self._take(")")
        return name

    def _assignment(self) -> None:
        if self._next == "local":
            self._take()
        start = self._place
        name = self._name()
        table, key = self._reader.values, name
        path = [name]
        while self._next in (".", "["):
            inner = table.get(key)
            if inner is None:
                inner = table[key] = {}  # tolerated: tables of the original that are not read
            if not isinstance(inner, dict):
                raise self._error(f"{'.'.join(path)} is no table")
            table, key = inner, self._key()
            path.append(str(key))
        if self._next != "=":
            self._place = start
            raise self._error(f"only assignments, include and return are read here, not {name!r}")
        self._take("=")
        table[key] = self._expression()
        self._reader.assigned.append(".".join(path))

    def _key(self) -> str | int:
        if self._take(".", "[") == ".":
            return self._name()
        key = self._index(self._expression())
        self._take("]")
        return key

    def _index(self, value: LuaValue) -> str | int:
        if isinstance(value, str):
            return value
        if isinstance(value, float) and value.is_integer():
            return int(value)
        raise self._error("an index is a text or a whole number")

    # -- expressions

    def _expression(self, precedence: int = 0) -> LuaValue:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise self._error(f"nested deeper than {_MAX_DEPTH} times")
        left = self._operand()
        while _PRECEDENCE.get(self._next, 0) > precedence:
            sign = self._take()
            own = _PRECEDENCE[sign]
            right = self._expression(own - 1 if sign in ("^", "..") else own)
            left = self._join(left, right) if sign == ".." else self._calculate(sign, left, right)
        self._depth -= 1
        return left

    def _join(self, left: LuaValue, right: LuaValue) -> str:
        if not isinstance(left, str) or not isinstance(right, str) or len(left) + len(right) > _MAX_TEXT:
            raise self._error("'..' joins two short texts")
        return left + right

    def _calculate(self, sign: str, left: LuaValue, right: LuaValue) -> float:
        a, b = self._number(left), self._number(right)
        try:
            match sign:
                case "+":
                    return a + b
                case "-":
                    return a - b
                case "*":
                    return a * b
                case "/":
                    return a / b
                case _:
                    return math.pow(a, b)
        except (ArithmeticError, ValueError):
            raise self._error(f"{a:g} {sign} {b:g} is no number") from None

    def _number(self, value: LuaValue) -> float:
        if isinstance(value, bool) or not isinstance(value, float):
            raise self._error("arithmetic needs numbers")
        return value

    def _operand(self) -> LuaValue:
        token = self._tokens[self._place]
        match token.kind, token.text:
            case "number", text:
                self._take()
                return self._literal(text)
            case "text", text:
                self._take()
                return self._string(text)
            case _, "{":
                return self._table()
            case _, "(":
                self._take()
                value = self._expression()
                self._take(")")
                return value
            case _, "-":
                self._take()
                return -self._number(self._expression(_UNARY))
            case "name", text:
                return self._variable() if text not in ("true", "false", "nil") else self._constant()
            case _:
                raise self._error(f"expected a value, got {token.text}")

    def _literal(self, text: str) -> float:
        try:
            return float(int(text, 16)) if text[:2].lower() == "0x" else float(text)
        except OverflowError:
            raise self._error("a number is too large") from None

    def _constant(self) -> bool | None:
        return {"true": True, "false": False, "nil": None}[self._take()]

    def _variable(self) -> LuaValue:
        path = [self._name()]
        value = self._reader.values.get(path[0])
        while self._next in (".", "["):
            key = self._key()
            if path == ["math"] and key in _FUNCTIONS:
                return self._function(str(key))
            if not isinstance(value, dict):
                raise self._error(f"{'.'.join(path)} is no table")
            path.append(str(key))
            value = value.get(key)
        if self._next == "(":
            raise self._error(f"the function {'.'.join(path)} is not known; known: math.{', math.'.join(_FUNCTIONS)}")
        return value

    def _function(self, name: str) -> float:
        self._take("(")
        value = self._number(self._expression())
        self._take(")")
        try:
            return float(_FUNCTIONS[name](value))
        except (ArithmeticError, ValueError):
            raise self._error(f"math.{name}({value:g}) is no number") from None

    def _table(self) -> LuaTable:
        table: LuaTable = {}
        self._take("{")
        count = 0
        while self._next != "}":
            following = self._tokens[min(self._place + 1, len(self._tokens) - 1)].text
            if self._next == "[":
                key = self._key()
                self._take("=")
                table[key] = self._expression()
            elif self._tokens[self._place].kind == "name" and following == "=":
                name = self._name()
                self._take("=")
                table[name] = self._expression()
            else:
                count += 1
                table[count] = self._expression()
            if self._take(",", ";", "}") == "}":
                return table
        self._take("}")
        return table

    def _string(self, quoted: str) -> str:
        return re.sub(r"\\(.)", lambda match: _ESCAPES.get(match[1], match[1]), quoted[1:-1], flags=re.DOTALL)

"""Substitution args of launch files: `$(find p)`, `$(arg x)`, `$(env V)`, …"""

import os
import re
from collections import ChainMap
from collections.abc import Callable, Mapping
from typing import Any

import rospkg

from rosgraph.names import anonymous_name
from trundle.base.expressions import MATH_NAMES, PYTHON_NAMES, ExpressionError, Interpreter, wrap_function
from trundle.robots.launch import convert_value

_COMMANDS = ["find", "env", "optenv", "dirname", "anon", "arg"]
_SUBSTITUTION = re.compile(r"\$+\(([^)]+)\)")
_EVAL = "$(eval "
_NAMES: Mapping[str, Any] = {"true": True, "false": False, **PYTHON_NAMES, **MATH_NAMES}


class SubstitutionException(Exception):
    """A substitution cannot be resolved."""


class ArgException(SubstitutionException):
    """An argument has no value."""


def resolve_args(
    arg_str: Any, context: dict[str, Any] | None = None, resolve_anon: bool = True, filename: str | None = None
) -> Any:
    """Text with its substitutions resolved; None and '' unchanged.

    Args:
        arg_str: text with substitutions.
        context: `arg`: values of arguments; `anon`: generated names, which it updates; `filename`: for `$(dirname)`.
        resolve_anon: no effect, as in roslaunch.
        filename: no effect, as in roslaunch.

    Raises:
        SubstitutionException: a substitution is unknown or has no value.
        rospkg.ResourceNotFound: no such package.
    """
    del resolve_anon, filename
    if not arg_str:
        return arg_str
    values: dict[str, Any] = {} if context is None else context
    if arg_str.startswith(_EVAL) and arg_str.endswith(")"):
        return _eval(arg_str[len(_EVAL) : -1], values)
    for is_find in (False, True):  # `$(find)` last, as a package's path may contain substitutions
        arg_str = _SUBSTITUTION.sub(lambda match, is_find=is_find: _replaced(match, is_find, values), arg_str)
    return arg_str


def _replaced(match: "re.Match[str]", is_find: bool, context: dict[str, Any]) -> str:
    body: str = match[1]
    if "$" in body:
        raise SubstitutionException(f"Dollar signs '$' cannot be inside of substitution args [{match.string}]")
    if "(" in body:
        raise SubstitutionException(f"Invalid left parenthesis '(' in substitution args [{match.string}]")
    command, *words = body.split() or [""]
    if command not in _COMMANDS:
        raise SubstitutionException(f"Unknown substitution command [{body}]. Valid commands are {_COMMANDS}")
    if (command == "find") != is_find:
        return match[0]
    dollars = match[0][: match[0].index("$(")]
    if command == "dirname":
        return dollars + _dirname(context)
    if not words or (len(words) > 1 and command != "optenv"):
        raise SubstitutionException(f"$({command} …) takes one name [{body}]")
    if command == "optenv":
        return dollars + os.environ.get(words[0], " ".join(words[1:]))
    if command == "find":
        following = match.string[match.end() : match.end() + 1]
        return dollars + _find(words[0]) + ("" if following in ("", " ", "/", "\\") else "/")
    return dollars + str(_FUNCTIONS[command](words[0], context))


def _env(name: str, context: dict[str, Any]) -> str:
    del context
    if name not in os.environ:
        raise SubstitutionException(f"environment variable '{name}' is not set")
    return os.environ[name]


def _anon(name: str, context: dict[str, Any]) -> str:
    names = context.setdefault("anon", {})
    return names.setdefault(name, anonymous_name(name))


def _arg(name: str, context: dict[str, Any]) -> Any:
    values = context.setdefault("arg", {})
    if name not in values:
        raise ArgException(name)
    return values[name]


def _dirname(context: dict[str, Any]) -> str:
    if not context.get("filename"):
        raise SubstitutionException("Cannot substitute $(dirname), no file/directory information available.")
    return os.path.abspath(os.path.dirname(context["filename"]))


def _find(name: str) -> str:
    return str(rospkg.RosPack().get_path(name))


_FUNCTIONS: dict[str, Callable[[str, dict[str, Any]], Any]] = {"env": _env, "anon": _anon, "arg": _arg}


def _eval(text: str, context: dict[str, Any]) -> str:
    if "__" in text:
        raise SubstitutionException("$(eval ...) may not contain double underscore expressions")

    def arg(name: str) -> Any:
        return convert_value(str(_arg(name, context)), "auto")

    def anon(name: str) -> str:
        return _anon(name, context)

    def dirname() -> str:
        return _dirname(context)

    def env(name: str) -> str:
        return _env(name, context)

    def optenv(name: str, default: str = "") -> str:
        return os.environ.get(name, default)

    functions = {"arg": arg, "anon": anon, "dirname": dirname, "env": env, "find": _find, "optenv": optenv}
    wrapped: dict[str, Any] = {name: wrap_function(function) for name, function in functions.items()}
    arguments: dict[str, Any] = {
        name: convert_value(str(value), "auto") for name, value in context.get("arg", {}).items()
    }
    try:
        return str(Interpreter().evaluate(text, ChainMap(wrapped, dict(_NAMES), arguments)))
    except ExpressionError as error:
        raise SubstitutionException(f"$(eval {text}): {error}") from None

"""Substitution args of launch files: `$(arg x)`, `$(find p)`, `$(env V)`, …, as in roslaunch."""

import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import DescriptionError, Source, nearest
from trundle.base.expressions import MATH_NAMES, PYTHON_NAMES, ExpressionError, Interpreter, wrap_function

from .files import LaunchFiles
from .missing_packages import MissingPackageError, MissingPackages
from .packages import PackageFinder
from .scope import Scope
from .values import convert_value

_COMMAND = re.compile(r"\$+\(([^)]+)\)")
_MAX_LENGTH = 400
"""Maximum length of an expression, and of its error, in a message."""
_BASE_NAMES: Mapping[str, Any] = {"true": True, "false": False, **PYTHON_NAMES, **MATH_NAMES}
"""Names available in every expression, besides the functions that depend on the file.

Includes Python builtins: roslaunch does not intend them, but its eval provides them and launch files use them.
"""
_MISSING_ROOT = "/no-package/"
"""Root of the paths that stand for missing packages in a tolerant reading."""
_IN_MISSING = re.compile(rf"{_MISSING_ROOT}([\w.-]+)")
_COMMANDS = ("find", "env", "optenv", "dirname", "anon", "arg")


@dataclass(frozen=True, slots=True, kw_only=True)
class Substitution:
    """Substitution of a whole launch."""

    packages: PackageFinder
    env: Mapping[str, str]
    anonymous: Callable[[str], str]
    """Creates a unique name."""
    missing: MissingPackages | None = None
    """Collects missing packages; None: the first one raises."""
    files: LaunchFiles = field(default_factory=LaunchFiles)
    interpreter: Interpreter = field(default_factory=Interpreter)
    """Evaluates every `$(eval …)`."""

    def resolve(self, text: str, scope: Scope, at: Source) -> str:
        """Replace every `$(…)` of an attribute.

        `find` is replaced last: arguments may contain it, and its path may contain the others.

        Raises:
            DescriptionError: unknown argument, variable, package or command.
        """
        if "$" not in text:
            return text
        if text.startswith("$(eval ") and text.endswith(")"):
            return self._eval(text[len("$(eval ") : -1], scope, at)
        for commands in (("env", "optenv", "dirname", "anon", "arg"), ("find",)):
            text = self._replace(text, commands, scope, at)
        return text

    def refuse_missing(self, text: str, at: Source) -> None:
        """Refuse a substituted text that names a file of a missing package.

        Raises:
            MissingPackageError: the text names one; an <arg> may contain it, as long as no other element uses it.
        """
        if self.packages.is_lenient and (match := _IN_MISSING.search(text)):
            raise MissingPackageError(at, f"no package {match[1]!r}")

    def refuse_absent(self, file: str, at: Source) -> None:
        """Refuse a missing file of a missing package.

        Raises:
            MissingPackageError: the package is missing; the stand-ins of its nodes have no files.
        """
        name = self.packages.absent_package(Path(file))
        if name is None:
            return
        if self.missing is not None:
            self.missing.add(name, at)
        raise MissingPackageError(at, f"{self.packages.not_found_message(name)}; its stand-in has no {Path(file).name}")

    def _replace(self, text: str, commands: tuple[str, ...], scope: Scope, at: Source) -> str:
        def value(match: re.Match[str]) -> str:
            body: str = match[1]
            if "$" in body or "(" in body:
                raise DescriptionError(
                    at, f"{match[0]!r}: substitutions cannot hold one another outside $(eval …)", "launch-substitution"
                )
            words = [word for word in body.split(" ") if word]
            if not words or words[0] not in _COMMANDS:
                commands_text = ", ".join(_COMMANDS)
                extra = "; eval must be the whole attribute" if words and words[0] == "eval" else ""
                raise DescriptionError(
                    at, f"unknown substitution $({body}); there are {commands_text}{extra}", "launch-substitution"
                )
            if words[0] not in commands:
                return match[0]
            before = match[0][: match[0].index("$(")]
            # As in roslaunch, text after a folder up to a blank is a path in it, with or without a slash.
            separator = (
                "/" if words[0] == "find" and match.string[match.end() :][:1] not in ("", " ", "/", "\\") else ""
            )
            replaced = before + self._command(words[0], words[1:], body, scope, at) + separator
            self.files.budget.add_octets(len(replaced), at)
            return replaced

        return _COMMAND.sub(value, text)

    def _command(self, command: str, words: list[str], body: str, scope: Scope, at: Source) -> str:
        if command == "dirname":
            return _folder(scope)
        if not words or (len(words) > 1 and command != "optenv"):
            raise DescriptionError(
                at, f"$({body}): {command!r} takes one name, got {len(words)}", "launch-substitution"
            )
        name = words[0]
        match command:
            case "arg":
                return self._arg(name, scope, at)
            case "env":
                return self._env(name, at)
            case "optenv":
                return self.env.get(name, " ".join(words[1:]))
            case "anon":
                return self._anon(name, scope)
            case _:
                return self._find(name, at)

    def _arg(self, name: str, scope: Scope, at: Source) -> str:
        if name in scope.arguments:
            return scope.arguments[name]
        if name in scope.declared:
            remedy = f"write {name}:=VALUE, or launch a file that includes this one with it"
            raise DescriptionError(at, f"the argument {name!r} is required and was not given; {remedy}", "launch-arg")
        declared = ", ".join(map(repr, sorted(scope.declared)))
        hint = f"; declared so far: {declared}" if declared else "; none is declared so far"
        nearest_name = nearest(name, set(scope.arguments) - scope.declared)
        suggestion = f"; {nearest_name!r} is given" if nearest_name else ""
        raise DescriptionError(at, f"no argument {name!r}{hint}{suggestion}", "launch-arg")

    def _env(self, name: str, at: Source) -> str:
        if name not in self.env:
            raise DescriptionError(at, f"the environment variable {name!r} is not set", "launch-substitution")
        return self.env[name]

    def _anon(self, name: str, scope: Scope) -> str:
        return scope.anonymous.setdefault(name, self.anonymous(name))

    def _find(self, name: str, at: Source) -> str:
        folder = self.packages.find_folder(name)
        if name == "xacro" and (folder is None or not os.path.isdir(folder)):
            # Trundle expands xacro itself; `$(find xacro)/xacro` only has to stay recognizable as one word.
            return "xacro"
        if folder is not None:
            return str(folder)
        if self.missing is not None:
            self.missing.add(name, at)
        elif not self.packages.is_lenient:
            raise MissingPackageError(at, self.packages.not_found_message(name))
        return f"{_MISSING_ROOT}{name}"

    def _eval(self, text: str, scope: Scope, at: Source) -> str:
        def arg(name: str) -> Any:
            return convert_value(self._arg(name, scope, at), "auto")

        def env(name: str) -> str:
            return self._env(name, at)

        def optenv(name: str, default: str = "") -> str:
            return self.env.get(name, default)

        def find(name: str) -> str:
            return self._find(name, at)

        def anon(name: str) -> str:
            return self._anon(name, scope)

        def dirname() -> str:
            return _folder(scope)

        functions = {f.__name__: wrap_function(f) for f in (arg, env, optenv, find, anon, dirname)}
        try:
            if "__" in text:  # roslaunch's rule and message
                raise ExpressionError("may not contain double underscores")
            return str(self.interpreter.evaluate(text, _Names(scope.arguments, functions)))
        except DescriptionError:
            raise
        except Exception as error:  # an expression may raise anything
            message = f"not a Python expression: {error.msg}" if isinstance(error, SyntaxError) else str(error)
            raise DescriptionError(
                at,
                f"$(eval {text[:_MAX_LENGTH]}): {message[:_MAX_LENGTH] or type(error).__name__}",
                "launch-substitution",
            ) from None


class _Names(Mapping[str, Any]):
    """Names in an expression: functions and constants first, then the file's arguments, typed."""

    def __init__(self, arguments: Mapping[str, str], functions: Mapping[str, Any]) -> None:
        self._arguments = arguments
        self._names = {**_BASE_NAMES, **functions}

    def __getitem__(self, name: str) -> Any:
        return self._names[name] if name in self._names else convert_value(self._arguments[name], "auto")

    def __iter__(self) -> Iterator[str]:
        return iter({*self._names, *self._arguments})

    def __len__(self) -> int:
        return len({*self._names, *self._arguments})


def _folder(scope: Scope) -> str:
    return str(Path(scope.file).parent.absolute())

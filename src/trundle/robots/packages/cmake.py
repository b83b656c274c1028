"""Partial interpreter of CMakeLists.txt: the programs and libraries that a package builds, and the files that it
configures.
"""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from trundle.base.files import read_text

from .cmake_commands import Command, Word, block_end, branches, is_true, parse_commands

_VARIABLE = re.compile(r"\$\{(\w+)\}")
_ESCAPE = re.compile(r"\\(.)", re.DOTALL)
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r"}
_LITERAL = re.compile(r"(?:[\w/-]|\\\\?\.)+\$?")
"""Regular expression of plain text, optionally anchored at the end; others are not evaluated."""
_ADD_EXECUTABLE = re.compile(r"(\w+_)?add_executable")
"""add_executable, and its variants in rosbuild, catkin_simple and CUDA."""
_ADD_LIBRARY = re.compile(r"(\w+_)?add_library")
_TARGET_OPTIONS = frozenset({"EXCLUDE_FROM_ALL", "MACOSX_BUNDLE", "WIN32", "STATIC", "SHARED", "MODULE", "OBJECT"})
_MAX_FOLDERS = 20
"""Maximum number of files read, as a CMakeLists.txt may add itself."""
_MAX_DEPTH = 20
"""Maximum depth of nested blocks."""
_MAX_COMMANDS = 20_000
"""Maximum number of commands run; those in a loop count in each round."""
_MAX_GLOBBED = 200
_MAX_CONFIGURED = 200
_MAX_CHARACTERS, _MAX_LENGTH = 1_000_000, 1000
"""Maximum total size of the variables, and of one: a few lines of `set(A ${A}${A})` grow without bound."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CMakeProgram:
    """Executable or library target."""

    name: str
    """File name of the built program; for a library, without `lib` and suffix."""
    target: str
    sources: tuple[str, ...]
    """Sources as written, with known variables replaced."""
    file: Path
    line: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfiguredFile:
    """`configure_file` command."""

    template: Path
    output: Path
    copies: bool
    """COPYONLY: no variable is replaced."""
    only_at: bool
    """@ONLY: only `@…@` is replaced."""
    variables: dict[str, list[str]]


def cmake_programs(folder: Path) -> list[CMakeProgram]:
    """Return the programs of a package, including those of its subdirectories."""
    reader = _read(folder)
    return [replace(program, name=reader.output_names.get(program.target, program.name)) for program in reader.programs]


def cmake_libraries(folder: Path) -> list[CMakeProgram]:
    """Return the libraries of a package, including plugins and libraries without sources."""
    reader = _read(folder)
    return [
        replace(library, name=reader.output_names.get(library.target, library.name)) for library in reader.libraries
    ]


def cmake_configured(folder: Path) -> list[ConfiguredFile]:
    """Return a package's `configure_file` commands whose output does not depend on the build folder."""
    return _read(folder).configured


def cmake_message_folders(folder: Path) -> dict[str, list[Path]]:
    """Return the folders of messages, services and actions that DIRECTORY names, by kind: msg, srv, action."""
    return _read(folder).message_folders


def _read(folder: Path) -> "_Reader":
    reader = _Reader(folder)
    reader.read(folder)
    return reader


class _Reader:
    """Interpreter of commands in order; if only CMake can evaluate a condition, every branch is run."""

    def __init__(self, package: Path) -> None:
        self.programs: list[CMakeProgram] = []
        self.libraries: list[CMakeProgram] = []
        self.configured: list[ConfiguredFile] = []
        self.message_folders: dict[str, list[Path]] = {}
        self.output_names: dict[str, str] = {}
        """Target → OUTPUT_NAME."""
        self._package = str(package)
        self._devel = next((str(up.parent / "devel") for up in package.parents if up.name == "src"), "")
        """Devel space of the package's workspace; "": none."""
        self._variables: dict[str, list[str]] = {
            "PROJECT_NAME": [package.name],
            "CMAKE_PROJECT_NAME": [package.name],
            "PROJECT_SOURCE_DIR": [self._package],
            f"{package.name}_SOURCE_DIR": [self._package],
            "CMAKE_SOURCE_DIR": [self._package],
            "CATKIN_DEVEL_PREFIX": [self._devel],
            "CATKIN_PACKAGE_SHARE_DESTINATION": [f"share/{package.name}"],
            "UNIX": ["1"],
            "WIN32": [""],
            "MSVC": [""],
            "APPLE": [""],
        }
        self._folders = 0
        self._depth = 0
        self._commands = 0
        self._budget = _MAX_CHARACTERS

    def read(self, folder: Path) -> None:
        """Read a folder's CMakeLists.txt, if it exists."""
        self._folders += 1
        file = folder / "CMakeLists.txt"
        try:
            text = read_text(file)
        except OSError:
            return
        outer = self._variables.get("CMAKE_CURRENT_SOURCE_DIR", [])
        for name in ("CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR"):
            self._variables[name] = [str(folder)]
        self._run(parse_commands(text), file)
        for name in ("CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR"):
            self._variables[name] = outer

    def _run(self, commands: Sequence[Command], file: Path) -> None:
        self._depth += 1
        index = 0
        while index < len(commands) and self._depth <= _MAX_DEPTH:
            command = commands[index]
            self._commands += 1
            if self._commands > _MAX_COMMANDS:
                break
            if command.name in ("if", "foreach"):
                end = block_end(commands, index)
                (self._if if command.name == "if" else self._foreach)(commands[index:end], file)
                index = end
            elif words := self._expanded(command.words):
                self._run_one(command, words, file)
            index += 1
        self._depth -= 1

    def _if(self, block: Sequence[Command], file: Path) -> None:
        for first, body in branches(block):
            value = True if first.name == "else" else is_true(self._expanded(first.words), self._variables)
            if value is not False:
                self._run(body, file)
            if value:
                return

    def _foreach(self, block: Sequence[Command], file: Path) -> None:
        match self._expanded(block[0].words):
            case [name, "RANGE", last] if last.isdecimal() and len(last) < len(str(_MAX_COMMANDS)):
                items = [str(value) for value in range(int(last) + 1)]
            case [name, "IN", *rest]:
                items = [value for word in rest for value in self._variables.get(word, [word])]
                items = [value for value in items if value not in ("LISTS", "ITEMS")]
            case [name, *items]:
                pass
            case _:
                return
        for value in [path for item in items for path in self._globbed(item, file.parent)]:
            self._variables[name] = [value]
            self._run(block[1:], file)

    def _globbed(self, item: str, folder: Path) -> list[str]:
        """Return the package's files that match a pattern; an item that is no pattern stays as it is."""
        if "*" not in item or ".." in item or "**" in item:
            return [item]
        try:
            paths = sorted(folder.glob(os.path.relpath(folder / item, folder)))
        except (OSError, ValueError, NotImplementedError):
            return []
        paths = [path for path in paths[:_MAX_GLOBBED] if path.is_relative_to(self._package)]
        return [str(path if os.path.isabs(item) else path.relative_to(folder)) for path in paths]

    def _run_one(self, command: Command, words: list[str], file: Path) -> None:
        match command.name, words:
            case "project", [name, *_]:
                self._variables["PROJECT_NAME"] = [name]
                self._variables["CATKIN_PACKAGE_SHARE_DESTINATION"] = [f"share/{name}"]
                self._variables[f"{name}_SOURCE_DIR"] = [self._package]
            case "set", [name, *values]:
                values = values[: values.index("CACHE")] if "CACHE" in values else values
                self._variables[name] = [value.replace(f"${{{name}}}", "") for value in values]  # unset before
            case "option", [name, *rest]:
                self._variables.setdefault(name, rest[1:2] or ["OFF"])
            case "list", ["APPEND", name, *values]:
                self._variables[name] = [*self._variables.get(name, []), *values]
            case "file", ["GLOB" | "GLOB_RECURSE", name, *patterns]:
                self._variables[name] = _patterns(patterns, file.parent)
            case "get_filename_component", [name, path, part, *_]:
                self._variables[name] = [_file_name_part(path, part)]
            case "string", ["REPLACE", old, new, name, *texts] if old:
                self._set_text(name, "".join(texts).replace(old, new))
            case "string", ["REGEX", "REPLACE", old, new, name, *texts] if _LITERAL.fullmatch(old):
                self._set_text(name, _replaced("".join(texts), old.replace("\\", ""), new))
            case "add_subdirectory", [subfolder, *_] if self._folders < _MAX_FOLDERS:
                self.read(file.parent / subfolder)
            case "configure_file", [template, output, *rest]:
                self._configure(file.parent / template, output, rest)
            case (("add_message_files" | "add_service_files" | "add_action_files"), _) if "DIRECTORY" in words[:-1]:
                kind = {"m": "msg", "s": "srv", "a": "action"}[command.name[4]]
                self.message_folders.setdefault(kind, []).append(file.parent / words[words.index("DIRECTORY") + 1])
            case _:
                self._add_target(command, words, file)

    def _add_target(self, command: Command, words: list[str], file: Path) -> None:
        match command.name, words:
            case "set_target_properties", [target, *properties] if "OUTPUT_NAME" in properties[:-1]:
                self.output_names[target] = properties[properties.index("OUTPUT_NAME") + 1]
            case name, [target, *rest] if _ADD_EXECUTABLE.fullmatch(name):
                self.programs.append(self._target(target, rest, file, command.line))
            case name, [target, *rest] if _ADD_LIBRARY.fullmatch(name):
                self.libraries.append(self._target(target, rest, file, command.line))
            case _:
                pass

    def _target(self, name: str, words: list[str], file: Path, line: int) -> CMakeProgram:
        sources = tuple(word.removeprefix(f"{file.parent}/") for word in words if word not in _TARGET_OPTIONS)
        return CMakeProgram(name=name, target=name, sources=sources, file=file, line=line)

    def _configure(self, template: Path, output: str, options: Sequence[str]) -> None:
        shared = f"{self._devel}/{self._variables['CATKIN_PACKAGE_SHARE_DESTINATION'][0]}/"
        if output.startswith(shared):
            output = os.path.join(self._package, output.removeprefix(shared))  # roslaunch searches both folders
        if not os.path.isabs(output) or len(self.configured) == _MAX_CONFIGURED:
            return  # the output is in the build folder, or has an unknown variable
        path = Path(output, template.name) if os.path.isdir(output) else Path(output)
        self.configured.append(
            ConfiguredFile(
                template=template,
                output=path,
                copies="COPYONLY" in options,
                only_at="@ONLY" in options,
                variables=dict(self._variables),
            )
        )

    def _set_text(self, name: str, text: str) -> None:
        self._variables[name] = [text[:_MAX_LENGTH]]

    def _expanded(self, words: Sequence[Word]) -> list[str]:
        return [value for word in words for value in self._expand(word)]

    def _expand(self, word: Word) -> list[str]:
        """Return a word with known variables replaced; a single variable may expand to several words."""
        if self._budget < 0:
            return [word.text]
        whole = None if word.is_quoted else _VARIABLE.fullmatch(word.text)
        if whole is not None:
            words = self._variables.get(whole[1], [word.text])
        else:
            text = (
                _ESCAPE.sub(lambda match: _ESCAPED.get(match[1], match[1]), word.text) if word.is_quoted else word.text
            )
            words = [
                _VARIABLE.sub(lambda match: ";".join(self._variables.get(match[1], [match[0]]))[:_MAX_LENGTH], text)
            ]
        self._budget -= sum(map(len, words))
        return words


def _patterns(words: Sequence[str], folder: Path) -> list[str]:
    """Return the patterns of file(GLOB), absolute unless preceded by RELATIVE and a folder."""
    words = [word for word in words if word != "CONFIGURE_DEPENDS"]
    if words[:1] == ["RELATIVE"]:
        return words[2:]
    return [os.path.join(folder, word) for word in words]


def _replaced(text: str, pattern: str, new: str) -> str:
    """Replace plain text; a pattern with a final `$` only at the end."""
    if not pattern.endswith("$"):
        return text.replace(pattern, new)
    ending = pattern.removesuffix("$")
    return text.removesuffix(ending) + new if text.endswith(ending) else text


def _file_name_part(path: str, part: str) -> str:
    folder, name = os.path.split(path)
    match part:
        case "NAME":
            return name
        case "NAME_WE":
            return name.partition(".")[0]
        case "NAME_WLE":
            return os.path.splitext(name)[0]
        case "DIRECTORY" | "PATH":
            return folder
        case _:
            return path

"""Programs and libraries that a package's CMakeLists.txt builds, as far as it is simple to read."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

from trundle.files import read_text

_COMMENT = re.compile(r"#\[\[.*?\]\]|#[^\n]*", re.DOTALL)
_COMMAND = re.compile(r"\b(\w+)\s*\(([^()]*)\)")
_WORD = re.compile(r'"([^"]*)"|([^\s";]+)')
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_ADDS = re.compile(r"(\w+_)?add_executable")
"""rosbuild, catkin_simple and CUDA have variants of the command."""
_ADDS_LIBRARY = re.compile(r"(\w+_)?add_library")
_NO_SOURCES = frozenset({"EXCLUDE_FROM_ALL", "MACOSX_BUNDLE", "WIN32", "STATIC", "SHARED", "MODULE", "OBJECT"})
_NO_COMPONENTS = frozenset({"REQUIRED", "QUIET", "EXACT", "CONFIG", "MODULE", "NO_MODULE", "OPTIONAL_COMPONENTS"})
_MAX_FOLDERS = 20
"""Most files read, because a CMakeLists.txt may add itself."""
_MAX_CHARACTERS, _LONGEST = 1_000_000, 1000
"""Largest size of all variables and of one: a few lines of `set(A ${A}${A})` grow without bound."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CMakeProgram:
    """Executable or library target."""

    name: str
    """File name of the built program; of a library without `lib` and suffix."""
    target: str
    sources: tuple[str, ...]
    """As written, with known variables replaced."""
    file: Path
    line: int


def cmake_programs(folder: Path) -> list[CMakeProgram]:
    """Return the programs of a package, including those of its subdirectories."""
    reader = _Reader(folder.name)
    reader.read(folder)
    return [replace(program, name=reader.output_names.get(program.target, program.name)) for program in reader.programs]


def cmake_libraries(folder: Path) -> list[CMakeProgram]:
    """Return the libraries of a package, plugins among them; those without sources of their own, too."""
    reader = _Reader(folder.name)
    reader.read(folder)
    return [replace(each, name=reader.output_names.get(each.target, each.name)) for each in reader.libraries]


def cmake_requirements(folder: Path) -> list[str]:
    """Return the packages that CMake has to find: catkin's components and others, such as Boost."""
    reader = _Reader(folder.name)
    reader.read(folder)
    return list(dict.fromkeys(reader.requirements))


class _Reader:
    """Reader of commands in order, as CMake, without conditions and loops."""

    def __init__(self, package: str) -> None:
        self.programs: list[CMakeProgram] = []
        self.libraries: list[CMakeProgram] = []
        self.requirements: list[str] = []
        self.output_names: dict[str, str] = {}
        """Target → OUTPUT_NAME."""
        self._variables: dict[str, list[str]] = {"PROJECT_NAME": [package], "CMAKE_PROJECT_NAME": [package]}
        self._folders = 0
        self._budget = _MAX_CHARACTERS

    def read(self, folder: Path) -> None:
        """Read a folder's CMakeLists.txt, if it exists."""
        self._folders += 1
        file = folder / "CMakeLists.txt"
        try:
            text = read_text(file)
        except OSError:
            return
        text = _COMMENT.sub(lambda match: "\n" * match[0].count("\n"), text)
        for match in _COMMAND.finditer(text):
            words = [word for quoted, plain in _WORD.findall(match[2]) for word in self._expanded(quoted or plain)]
            if words:
                self._run(match[1].lower(), words, file, text.count("\n", 0, match.start()) + 1)

    def _run(self, command: str, words: list[str], file: Path, line: int) -> None:
        match command, words:
            case "project", [name, *_]:
                self._variables["PROJECT_NAME"] = [name]
            case "set", [name, *values]:
                self._variables[name] = values
            case "file", ["GLOB" | "GLOB_RECURSE", name, *patterns]:
                self._variables[name] = patterns
            case "add_subdirectory", [inside, *_] if self._folders < _MAX_FOLDERS:
                self.read(file.parent / inside)
            case "set_target_properties", [target, *properties] if "OUTPUT_NAME" in properties[:-1]:
                self.output_names[target] = properties[properties.index("OUTPUT_NAME") + 1]
            case _, [target, *rest] if _ADDS.fullmatch(command):
                self.programs.append(_target(target, rest, file, line))
            case _, [target, *rest] if _ADDS_LIBRARY.fullmatch(command):
                self.libraries.append(_target(target, rest, file, line))
            case "find_package", ["catkin", *rest]:
                self.requirements += ["catkin", *(word for word in rest if word not in {*_NO_COMPONENTS, "COMPONENTS"})]
            case "find_package", [package, *_]:
                self.requirements.append(package)
            case _:
                pass

    def _expanded(self, word: str) -> list[str]:
        """Return a word with known variables replaced; a single variable may expand to several words."""
        if self._budget < 0:
            return [word]
        whole = _VARIABLE.fullmatch(word)
        if whole is not None:
            words = self._variables.get(whole[1], [word])
        else:
            words = [_VARIABLE.sub(lambda match: ";".join(self._variables.get(match[1], [match[0]]))[:_LONGEST], word)]
        self._budget -= sum(map(len, words))
        return words


def _target(name: str, words: list[str], file: Path, line: int) -> CMakeProgram:
    sources = tuple(word for word in words if word not in _NO_SOURCES)
    return CMakeProgram(name=name, target=name, sources=sources, file=file, line=line)

"""Expansion of xacro by the official package, with Trundle's package resolver and support for Indigo's syntax.

Indigo's xacro accepted `<property>`, `<macro>`, … and macro calls without the `xacro:` prefix; today's copies them to
the output as plain XML, silently, and the robot has no links. They are rewritten with a warning.
"""

import io
import itertools
import os
import sys
import threading
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, TextIO
from xml.parsers.expat import ErrorString, ExpatError

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UnknownArgumentError, nearest
from trundle.base.expressions import PYTHON_NAMES, Budget
from trundle.base.files import read_file
from trundle.base.xmlnode import ReadBudget, ReadBudgetError
from trundle.robots.packages import Packages, refuse_ros2_language

from ..xacro_sources import Cursor, parse_with_lines, source_of
from .dom import replace_node
from .missing_packages import MissingPackageError, skip_missing_packages
from .symbols import SubstitutedNames, install_symbols, new_interpreter


class _Yaml(ModuleType):
    """Lazy yaml module for the package's substitution_args, which imports it but rarely uses it."""

    def __getattr__(self, name: str) -> object:
        return getattr(import_module("yaml"), name)


class _CommandLine(ModuleType):
    """Replacement of the package's command line module, which is never used."""

    process_args = None


def _import_xacro() -> tuple[Any, Any]:
    stand_ins = {module.__name__: module for module in (_Yaml("yaml"), _CommandLine("xacro.cli"))}
    absent = stand_ins.keys() - sys.modules.keys()
    sys.modules.update({name: stand_ins[name] for name in absent})
    try:
        return import_module("xacro"), import_module("xacro.substitution_args")
    finally:
        for name in absent:
            del sys.modules[name]


xacro, substitution_args = _import_xacro()


install_symbols(xacro)


def _collect_args_for(original: Callable[[str], list[str]]) -> Callable[[str], list[str]]:
    """Skip the package's second pass over a substituted text, letter by letter, unless it contains `$`."""

    def collect_args(text: str) -> list[str]:
        return original(text) if "$" in text else []

    return collect_args


substitution_args._collect_args = _collect_args_for(substitution_args._collect_args)


_MAX_ELEMENTS = 50_000
"""Maximum elements after expansion; the largest published file has 45,667, the PR2 3,000."""
_CPU_S = 10.0
"""Processor time; more than for other formats, as a small file may expand to a large one: one published takes 3 s."""
_NODES_OF_A_CALL = 10
"""Elements that count for a macro call in the reading budget."""
_LONG_TEXT = 200
"""Length above which a text counts against the memory budget at each insertion."""
_LOCK = threading.Lock()
"""Lock of the package's state, which it keeps in module globals."""
_CORE = {
    "include": "filename",
    "property": "name",
    "macro": "name",
    "if": "value",
    "unless": "value",
    "insert_block": "name",
}
"""Indigo's tags without prefix, and the attribute that distinguishes them from plain XML of the same name."""
_BARE = tuple(f"<{tag}".encode() for tag in _CORE)
_URDF_TAGS = """
    robot link joint inertial visual collision origin geometry box cylinder sphere mesh material color
    texture mass inertia parent child axis limit dynamics mimic safety_controller calibration transmission
    actuator gazebo sensor plugin hardwareInterface mechanicalReduction type
"""
_URDF = frozenset(_URDF_TAGS.split())
"""URDF elements, which are never macro calls."""


def expand_xacro(
    path: Path,
    arguments: Mapping[str, str],
    *,
    packages: Packages,
    report: Diagnostics,
    data: bytes | None = None,
    needs_all: bool = False,
) -> str:
    """Expand a file; return the XML text.

    Args:
        path: top file.
        arguments: `name:=value` of the command line.
        packages: resolves `$(find …)`.
        report: receives notes of rewrites and xacro's warnings.
        data: contents of the top file if it is a pipe; relative paths then start in `path`'s folder.
        needs_all: raise an error for an argument that the file does not have; xacro itself ignores it.

    Raises:
        DescriptionError: the file cannot be expanded; the message is xacro's, with its source.
    """
    if data is None:
        if not os.path.exists(path):
            raise DescriptionError(Source(str(path)), "no such file", "missing-file")
        refuse_ros2_language(path, is_launch=False)
        packages = packages.around(path)
        try:
            data = read_file(path)
        except OSError as error:
            raise DescriptionError(Source(str(path)), str(error.strerror), "unreadable-file") from None
    cursor, budget = Cursor(Source(str(path))), ReadBudget(cpu_s=_CPU_S)
    with _LOCK, _patched(packages, report, path, data, cursor, budget):
        try:
            mappings = _Arguments(arguments)
            document: Any = xacro.process_file(str(path), mappings=mappings, verbosity=0)
            if needs_all:
                mappings.check_used(arguments, path)
            return str(document.toprettyxml(indent="  "))
        except ReadBudgetError as error:
            raise error.through(map(str, xacro.filestack)) from None
        except DescriptionError:
            raise
        except RecursionError:
            raise DescriptionError(
                cursor.at, "infinite recursion of elements, macros or properties", "xacro-recursion"
            ) from None
        except Exception as error:  # xacro evaluates the file's own Python, which may raise anything
            from .error import description_error

            raise description_error(error, cursor.at, path, map(str, xacro.all_includes)) from None


class _Arguments(dict[str, str]):
    """Arguments of a file; records which ones the file declares or uses."""

    def __init__(self, arguments: Mapping[str, str]) -> None:
        super().__init__(arguments)
        self._used: set[str] = set()

    def __contains__(self, name: object) -> bool:
        self._used.add(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self._used.add(name)
        return super().__getitem__(name)

    def check_used(self, arguments: Mapping[str, str], path: Path) -> None:
        """Raise an error for an argument that the file does not have."""
        if unknown := sorted(set(arguments) - self._used):
            names = ", ".join(repr(name) for name in sorted(self._used)) or "none"
            suggestion = nearest(unknown[0], self._used) if len(self._used) > 1 else None
            hint = f"; the nearest is {suggestion!r}" if suggestion else ""
            message = f"no argument {unknown[0]!r}{hint}; arguments here: {names}"
            raise UnknownArgumentError(Source(str(path)), message, "unknown-argument", name=unknown[0])


def _set_commands(functions: Mapping[str, Callable[..., str]]) -> None:
    """Set the package's functions for $(find …), $(env …), …, in attributes and in $(eval …)."""
    for command, function in functions.items():
        setattr(substitution_args, f"_eval_{command}", function)
        substitution_args._eval_dict[command] = function


@contextmanager
def _patched(
    packages: Packages, report: Diagnostics, path: Path, data: bytes, cursor: Cursor, budget: ReadBudget
) -> Generator[None]:
    """Replace functions of the official package while one file is expanded."""
    warned: set[str] = set()

    def find(name: str) -> str:
        folder = packages.find_folder(name)
        if folder is None:
            raise MissingPackageError(name, f"$(find {name}): {packages.not_found_message(name)}")
        if packages.stand_in_package(folder) is not None and name not in warned:
            warned.add(name)
            message = f"no package {name!r}: a stand-in of boxes is used; put the original on ROS_PACKAGE_PATH"
            report.warn(cursor.at, message, "stand-in-package")
        return str(folder)

    def warn(*words: object) -> None:
        report.warn(cursor.at, " ".join(map(str, words)), "xacro-warning")

    def open_readable(name: str) -> TextIO:
        packages.check_readable(Path(name), cursor.at, name="load_yaml")
        try:
            return io.StringIO(_data(name).decode())
        except UnicodeDecodeError:
            raise package.XacroException(f"{name}: it is not UTF-8 text") from None

    def env(name: str) -> str:
        value = packages.variable(name)
        if value is None:
            raise substitution_args.SubstitutionException(f"environment variable {name!r} is not set")
        return value

    def optenv(name: str, default: str = "") -> str:
        value = packages.variable(name)
        return default if value is None else value

    def substitution_eval(text: str, _: object, symbols: object) -> object:
        return interpreter.evaluate(text, SubstitutedNames(symbols, {**PYTHON_NAMES, "range": range}))

    package, arguments, interpreter = xacro, substitution_args, new_interpreter(xacro)
    names = (
        "parse", "eval_all", "handle_macro_call", "reqd_attrs", "warning", "print_location", "safe_eval", "eval_text",
        "process_doc", "process_include", "get_include_files", "replace_node",
    )  # fmt: skip
    originals = {name: getattr(package, name) for name in names}
    replaced = {"find": find, "env": env, "optenv": optenv}
    commands = {command: getattr(arguments, f"_eval_{command}") for command in replaced}
    package.parse = _parse_for(originals["parse"], packages, report, {str(path): data}, cursor, budget)
    package.eval_all = _eval_all_for(originals["eval_all"], cursor, budget)
    package.handle_macro_call = _call_for(originals["handle_macro_call"], report, cursor, budget)
    if packages.is_lenient:
        skip_missing_packages(package, packages, report)
    cursor.follow(package)
    package.replace_node = replace_node
    package.safe_eval = interpreter.evaluate
    package.eval_text = _eval_text_for(originals["eval_text"], interpreter.budget)
    package.warning = warn
    package.open = open_readable  # shadows the builtin `open`, with which the package's load_yaml would open any file
    package.print_location = lambda: None  # this function prints to stderr at a warning; the cursor has the position
    _set_commands(replaced)
    arguments.eval = substitution_eval  # shadows the builtin `open` in the package's module
    package.all_includes.clear()
    try:
        yield
    finally:
        for name, function in originals.items():
            setattr(package, name, function)
        _set_commands(commands)
        del arguments.eval
        package.filestack = package.macrostack = None
        del package.open


def _eval_text_for(original: Callable[..., object], budget: Budget) -> Callable[..., object]:
    """Skip the package's lexer, half of the total time, for text without `$`."""

    def eval_text(text: str, symbols: object) -> object:
        result = original(text, symbols) if "$" in text else text
        if isinstance(result, str) and len(result) > _LONG_TEXT:
            budget.allocate(len(result))  # a thousand elements may contain the text, and the output repeats it
        return result

    return eval_text


def _parse_for(
    original: Callable[..., Any],
    packages: Packages,
    report: Diagnostics,
    contents: Mapping[str, bytes],
    cursor: Cursor,
    budget: ReadBudget,
) -> Callable[..., Any]:
    """Return a parser with our checks; `contents` maps file names to contents that need no reading."""

    def parse(inp: object, filename: str | None = None) -> Any:
        if filename is None:
            return original(inp, filename)
        if filename not in contents:
            packages.check_readable(Path(filename), cursor.at, name="xacro:include")
            _expect_stand_in(Path(filename), packages, cursor.at)
        data = contents[filename] if filename in contents else _data(filename)
        budget.add_file(filename, len(data), cursor.at)
        document = _parsed(data, filename, report, budget)
        if any(start in data for start in _BARE):
            _prefix_core_tags(document, report)
        _drop_unnamed(document, report)
        return document

    return parse


def _parsed(data: bytes, filename: str, report: Diagnostics, budget: ReadBudget) -> Any:
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise DescriptionError(Source(filename), "a document type or entities of its own are not read", "xml-doctype")
    if data[:1].isspace() and data.lstrip().startswith(b"<?xml"):
        report.warn(
            Source(filename, 1),
            "blank lines before <?xml …?>, for which xacro refuses the file",
            "blank-lines-before-xml",
        )
    try:
        return parse_with_lines(data, filename, budget)
    except ExpatError as error:
        from trundle.base.xmlnode import parse_xml  # slow to load, and most files are well-formed

        parse_xml(data, name=filename)  # raises an error with a sentence
        message = f"not well-formed XML: {ErrorString(error.code)}"
        raise DescriptionError(Source(filename, error.lineno), message, "malformed-xml") from None


def _expect_stand_in(file: Path, packages: Packages, at: Source) -> None:
    package = packages.absent_package(file)
    if package is not None:
        message = f"{packages.not_found_message(package)}; its stand-in has no {file.name}"
        raise DescriptionError(at, message, "missing-package", missing_packages=(package,))


def _data(name: str) -> bytes:
    """Return the contents of a referenced file; a missing one is xacro's error, as an include may be optional."""
    try:
        return read_file(name)
    except OSError as error:
        raise xacro.XacroException(exc=error) from None


def _prefix_core_tags(document: Any, report: Diagnostics) -> None:
    """Add the prefix to Indigo's core tags."""
    rewritten: dict[str, Source] = {}
    for element in document.getElementsByTagName("*"):
        tag = element.tagName
        if tag in _CORE and element.hasAttribute(_CORE[tag]):
            has_elements = any(child.nodeType == child.ELEMENT_NODE for child in element.childNodes)
            if not (tag == "include" and has_elements):
                element.tagName = element.nodeName = f"xacro:{tag}"
                rewritten.setdefault(tag, source_of(element))
    for tag, at in sorted(rewritten.items()):
        report.warn(at, f"<{tag}> without the prefix xacro: is Indigo's syntax; read as <xacro:{tag}>", "xacro-prefix")


def _drop_unnamed(document: Any, report: Diagnostics) -> None:
    """Drop properties that no expression can reference; Indigo's xacro ignored them, today's refuses the file."""
    for element in document.getElementsByTagName("xacro:property"):
        name = str(element.getAttribute("name"))
        if element.hasAttribute("name") and not name.isidentifier():
            element.parentNode.removeChild(element)
            report.warn(
                source_of(element), f"a property named {name!r} cannot be referenced; it is left out", "xacro-property"
            )


def _eval_all_for(original: Callable[..., None], cursor: Cursor, budget: ReadBudget) -> Callable[..., None]:
    """Count every expansion of an element, macro or block."""
    elements = itertools.count()

    def eval_all(node: Any, macros: Any, symbols: Any) -> None:
        if next(elements) > _MAX_ELEMENTS:
            raise DescriptionError(
                cursor.at, f"macros and blocks that expand to more than {_MAX_ELEMENTS} elements", "too-large"
            )
        budget.add_nodes(1, cursor.at)
        original(node, macros, symbols)

    return eval_all


def _call_for(
    original: Callable[..., bool], report: Diagnostics, cursor: Cursor, budget: ReadBudget
) -> Callable[..., bool]:
    def handle_macro_call(node: Any, macros: Any, symbols: Any) -> bool:
        name = str(node.tagName)
        if ":" not in name and name not in _URDF and name in macros:
            report.warn(
                cursor.at, f"<{name}> calls a macro without the prefix xacro:; read as <xacro:{name}>", "xacro-prefix"
            )
            node.tagName = node.nodeName = f"xacro:{name}"
        if node.tagName.startswith("xacro:"):
            budget.add_nodes(_NODES_OF_A_CALL, cursor.at)
        return original(node, macros, symbols)

    return handle_macro_call

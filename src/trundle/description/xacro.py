"""Expands xacro with the official package: our package resolver in place of ament's, and a pass for Indigo's files.

Indigo's xacro took `<property>`, `<macro>`, … and calls of macros without the `xacro:` prefix; today's copies them to
the output as plain XML, without a word, and a robot has no links. The pass rewrites them and says so.
"""

import itertools
import re
import sys
import threading
import xml.dom.minidom
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, TextIO
from xml.parsers.expat import ExpatError

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.packages import Packages

from .xacro_expression import bounded_eval


class _Yaml(ModuleType):
    """In yaml's place for the package's substitution_args, which imports it and asks it for nothing in most files."""

    def __getattr__(self, name: str) -> object:
        return getattr(import_module("yaml"), name)


def _import_xacro() -> tuple[Any, Any]:
    absent = "yaml" not in sys.modules
    if absent:
        sys.modules["yaml"] = _Yaml("yaml")
    try:
        return import_module("xacro"), import_module("xacro.substitution_args")
    finally:
        if absent:
            del sys.modules["yaml"]


xacro, substitution_args = _import_xacro()

_REPEATED = re.compile(r"<class '[\w.]+'>: (.*?) \1")
"""How the package words an error of $(…): its class, then what it says, twice."""
_MOST_ELEMENTS = 500_000
"""What macros may expand to; the largest published robot has some 5,000."""
_LOCK = threading.Lock()
"""The package keeps its state in module globals."""
_CORE = {
    "include": "filename",
    "property": "name",
    "macro": "name",
    "if": "value",
    "unless": "value",
    "insert_block": "name",
}
"""Indigo's bare tags, and the attribute that tells them from plain XML of the same name."""
_URDF = frozenset(
    [
        "robot",
        "link",
        "joint",
        "inertial",
        "visual",
        "collision",
        "origin",
        "geometry",
        "box",
        "cylinder",
        "sphere",
        "mesh",
        "material",
        "color",
        "texture",
        "mass",
        "inertia",
        "parent",
        "child",
        "axis",
        "limit",
        "dynamics",
        "mimic",
        "safety_controller",
        "calibration",
        "transmission",
        "actuator",
        "gazebo",
        "sensor",
        "plugin",
        "hardwareInterface",
        "mechanicalReduction",
        "type",
    ]
)
"""Element names that stay what they are even where a macro has the same name."""
_ENTITY = re.compile(rb"<!(DOCTYPE|ENTITY)")


def expand_xacro(path: Path, arguments: Mapping[str, str], *, packages: Packages, report: Diagnostics) -> str:
    """Expand a file; return the XML text.

    Args:
        path: the top file.
        arguments: `name:=value` of the command line.
        packages: answers `$(find …)`.
        report: takes what was rewritten and what xacro warns of.

    Raises:
        DescriptionError: it cannot be expanded; the sentence is xacro's, with the file it was in.
    """
    if not path.is_file():
        raise DescriptionError(Source(str(path)), "no such file")
    with _LOCK, _ours(packages.around(path), report, path):
        try:
            document: Any = xacro.process_file(str(path), mappings=dict(arguments), verbosity=0)
            return str(document.toprettyxml(indent="  "))
        except DescriptionError:
            raise
        except RecursionError:
            raise DescriptionError(
                _where(path), "elements, macros or properties within one another without end"
            ) from None
        except ExpatError as error:
            raise DescriptionError(Source(_where(path).file, error.lineno), f"not well-formed XML: {error}") from None
        except Exception as error:  # xacro evaluates the file's own Python: anything may come out of it
            what = _REPEATED.sub(r"\1", " ".join(str(error).split())) or type(error).__name__
            raise DescriptionError(_where(path), what) from None


def _where(path: Path) -> Source:
    stack = [name for name in (xacro.filestack or []) if name]
    return Source(str(stack[-1]) if stack else str(path))


@contextmanager
def _ours(packages: Packages, report: Diagnostics, path: Path) -> Generator[None]:
    """Put our functions in the official package's place, for as long as one file takes."""

    def find(name: str) -> str:
        folder = packages.find_package(name)
        if folder is None:
            raise LookupError(f"$(find {name}): {packages.why_not_found(name)}")
        return str(folder)

    def warn(*words: object) -> None:
        report.warn(_where(path), " ".join(map(str, words)))

    def open_readable(name: str) -> TextIO:
        packages.check_readable(Path(name), _where(path), told="load_yaml")
        return Path(name).open(encoding="utf-8")

    package, arguments = xacro, substitution_args
    names = ("parse", "handle_macro_call", "warning", "print_location", "safe_eval")
    kept = {name: getattr(package, name) for name in names}
    own_find = arguments._eval_find
    package.parse = _parse_for(kept["parse"], packages, report)
    package.handle_macro_call = _call_for(kept["handle_macro_call"], report, path)
    package.safe_eval = bounded_eval
    package.warning = warn
    package.open = open_readable  # shadows the builtin that its load_yaml would open any file with
    package.print_location = lambda: None  # it writes to stderr where a warning was; `_where` says it
    arguments._eval_find = arguments._eval_dict["find"] = find
    arguments.eval = _substitution_eval  # in its module, in place of the builtin one
    package.all_includes.clear()
    try:
        yield
    finally:
        for name, function in kept.items():
            setattr(package, name, function)
        arguments._eval_find = arguments._eval_dict["find"] = own_find
        del arguments.eval
        package.filestack = package.macrostack = None
        del package.open


_HARMLESS = (abs, bool, dict, float, int, len, list, max, min, range, round, sorted, str, sum, tuple)


def _substitution_eval(expression: str, _: object, symbols: Any) -> object:
    """What `$(eval …)` means: the original lets it have every builtin."""
    return bounded_eval(expression, {function.__name__: function for function in _HARMLESS}, symbols)


def _parse_for(original: Callable[..., Any], packages: Packages, report: Diagnostics) -> Callable[..., Any]:
    def parse(inp: object, filename: str | None = None) -> Any:
        if filename is not None:
            packages.check_readable(Path(filename), Source(filename), told="xacro:include")
            data = Path(filename).read_bytes() if Path(filename).is_file() else b""
            if _ENTITY.search(data):
                raise DescriptionError(Source(filename), "a document type or entities of its own are not read")
            # Blank lines before <?xml …?> stop expat, and no robot.
            document = xml.dom.minidom.parseString(data.lstrip()) if data.strip() else original(inp, filename)
            _prefix_core_tags(document, filename, report)
            return document
        return original(inp, filename)

    return parse


def _prefix_core_tags(document: Any, filename: str, report: Diagnostics) -> None:
    """Give Indigo's bare core tags their prefix."""
    rewritten: set[str] = set()
    for element in document.getElementsByTagName("*"):
        tag = element.tagName
        if tag in _CORE and element.hasAttribute(_CORE[tag]):
            has_elements = any(child.nodeType == child.ELEMENT_NODE for child in element.childNodes)
            if not (tag == "include" and has_elements):
                element.tagName = element.nodeName = f"xacro:{tag}"
                rewritten.add(tag)
    for tag in sorted(rewritten):
        report.warn(Source(filename), f"<{tag}> without the prefix xacro: is Indigo's way; read as <xacro:{tag}>")


def _call_for(original: Callable[..., bool], report: Diagnostics, path: Path) -> Callable[..., bool]:
    calls = itertools.count()

    def handle_macro_call(node: Any, macros: Any, symbols: Any) -> bool:
        if next(calls) > _MOST_ELEMENTS:
            raise DescriptionError(_where(path), f"macros that expand to more than {_MOST_ELEMENTS} elements")
        name = str(node.tagName)
        if ":" not in name and name not in _URDF and name in macros:
            report.warn(_where(path), f"<{name}> calls a macro without the prefix xacro:; read as <xacro:{name}>")
            node.tagName = node.nodeName = f"xacro:{name}"
        return original(node, macros, symbols)

    return handle_macro_call

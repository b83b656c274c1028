"""Handling of missing packages: their includes and macro calls are left out, each with a warning."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import Diagnostics
from trundle.robots.packages import Packages

from ..xacro_sources import source_of

_DYNAMIC_CALL = "xacro:call"


class MissingPackageError(LookupError):
    """`$(find …)` of a missing package."""

    def __init__(self, name: str, message: str) -> None:
        """Create an error for the package `name`."""
        self.name = name
        super().__init__(message)


def skip_missing_packages(package: Any, packages: Packages, report: Diagnostics) -> None:
    """Patch the xacro package to skip includes of missing packages, and then calls of unknown macros.

    Args:
        package: xacro's module; the caller restores its functions.
        packages: resolves packages.
        report: receives a warning for each.
    """
    process_include, get_include_files = package.process_include, package.get_include_files
    handle_macro_call, resolve_macro = package.handle_macro_call, package.resolve_macro
    process_whole = package.process_doc
    included: list[Any] = []
    left_out: list[str] = []

    def note_include(node: Any, *rest: Any) -> None:
        included.append(node)
        process_include(node, *rest)

    def find_included_files(spec: str, symbols: Any) -> Iterator[str]:
        node = included.pop()
        try:
            files = list(get_include_files(spec, symbols))
        except Exception as error:
            missing = missing_package(error)
            if missing is None:
                raise
            left_out.append(spec)
            report.warn(source_of(node), f"{missing}; the include is left out", "lenient-include")
            return iter(())
        if files and packages.absent_package(Path(files[0])) is not None:
            left_out.append(spec)
            report.warn(
                source_of(node),
                f"{spec}: no such package, and its stand-in has no such file; the include is left out",
                "lenient-include",
            )
            return iter(())
        return iter(files)

    def is_unknown(node: Any, macros: Any, symbols: Any) -> bool:
        if not left_out or not node.tagName.startswith("xacro:") or node.tagName == _DYNAMIC_CALL:
            return False
        try:
            resolve_macro(node.tagName.partition(":")[2], macros, symbols)
        except KeyError:
            return True
        return False

    def call_macro(node: Any, macros: Any, symbols: Any) -> bool:
        if not is_unknown(node, macros, symbols):
            return bool(handle_macro_call(node, macros, symbols))
        report.warn(
            source_of(node),
            f"no macro <{node.tagName}>: the call is left out; it may come from an include left out",
            "lenient-include",
        )
        package.replace_node(node, by=None)
        return True

    def process_doc(document: Any, **rest: Any) -> None:
        process_whole(document, **rest)
        if left_out:
            _drop_loose(document.documentElement, report)

    package.process_doc = process_doc
    package.process_include = note_include
    package.get_include_files = find_included_files
    package.handle_macro_call = call_macro


def _drop_loose(robot: Any, report: Diagnostics) -> None:
    """Remove joints to missing links, and the children of such links."""
    links = {link.getAttribute("name"): link for link in _children(robot, "link")}
    joints = [(joint, _end(joint, "parent"), _end(joint, "child")) for joint in _children(robot, "joint")]
    loose = [joint_ends for joint_ends in joints if joint_ends[1] not in links or joint_ends[2] not in links]
    while loose:
        joint, parent, child = loose.pop()
        joints = [joint_ends for joint_ends in joints if joint_ends[0] is not joint]
        message = f"joint {joint.getAttribute('name')!r} is left out: no link"
        report.warn(source_of(joint), f"{message} {(child if parent in links else parent)!r}", "lenient-include")
        robot.removeChild(joint)
        if parent not in links and child in links:
            robot.removeChild(links.pop(child))
            loose = [joint_ends for joint_ends in joints if joint_ends[1] not in links or joint_ends[2] not in links]


def _children(node: Any, tag: str) -> list[Any]:
    return [child for child in node.childNodes if getattr(child, "tagName", None) == tag]


def _end(joint: Any, role: str) -> str:
    return next((str(end.getAttribute("link")) for end in _children(joint, role)), "")


def missing_package(error: BaseException | None) -> MissingPackageError | None:
    """Return the missing package that caused an error; None if the error has another cause."""
    while error is not None and not isinstance(error, MissingPackageError):
        error = getattr(error, "exc", None) or error.__context__
    return error

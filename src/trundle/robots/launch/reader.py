"""Reads launch files into a plan, with roslaunch's rules of scope and order."""

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import ReadBudgetError, XmlNode
from trundle.robots.names import anonymous_name, canonical_name

from .attributes import Attributes
from .command_line import CommandLine
from .files import LaunchFiles, ReadCheck
from .launch_file import parse_launch_text, read_launch_file
from .machines import read_machine
from .missing_packages import MissingPackageError, MissingPackages, element_name
from .nodes import read_node
from .packages import PackageFinder
from .params import read_param, read_rosparam
from .plan import LaunchArgument, LaunchPlan
from .plan_builder import PlanBuilder
from .remap_env import read_env, read_remap
from .scope import Scope
from .substitution import Substitution

ROS_VARIABLES = {"ROS_DISTRO": "noetic", "ROS_VERSION": "1"}
"""Environment variables that ROS' setup.bash sets, where no ROS is sourced."""
_MAX_INCLUDE_DEPTH = 64
"""Limit for files that include themselves; published launch files nest less than a tenth as deep."""
_MAX_INCLUDES_IN_ERROR = 8
"""Includes listed in an error."""


def read_launch(
    files: Path | Sequence[Path],
    /,
    *,
    packages: PackageFinder,
    report: Diagnostics,
    arguments: Mapping[str, str] | None = None,
    env: Mapping[str, str] | None = None,
    texts: Sequence[tuple[str, str]] = (),
    namespace: str = "/",
    check_readable: ReadCheck | None = None,
) -> LaunchPlan:
    """Read launch files as one launch, without starting nodes or running commands.

    Args:
        files: one or more files, read in order.
        texts: (name, XML) of launch files not on disk, such as standard input; read after the files.
        packages: resolves `$(find …)`.
        report: receives warnings: unknown tags and attributes, deprecations, unsupported features.
        arguments: `name:=value` of the command line.
        env: environment for `$(env …)` and `$(optenv …)`; `ROS_VARIABLES` are added.
        namespace: prefix of all names.
        check_readable: refuses files named by elements, for a launch file that is only inspected; None: reads all.

    Raises:
        DescriptionError: the file is invalid, with file and line; roslaunch rejects it too.
    """
    command_line = CommandLine(arguments or {})

    def read(report: Diagnostics, missing: MissingPackages | None = None) -> LaunchPlan:
        reader = _Reader(
            packages=packages,
            report=report,
            env={**ROS_VARIABLES, **(env or {})},
            command_line=command_line,
            missing=missing,
            files=LaunchFiles(check_readable),
        )
        for file in [files] if isinstance(files, Path) else files:
            reader.read_root(read_launch_file(file, report), file, namespace)
        for name, text in texts:
            reader.read_root(parse_launch_text(text, name), Path(name), namespace)
        return reader.builder.build()

    try:
        plan = read(report)
    except MissingPackageError as error:
        missing = MissingPackages()
        with suppress(DescriptionError):
            missing.add_nodes(read(Diagnostics(), missing).nodes, packages)
        raise missing.combined_error(error) from None
    command_line.check_unused()
    return plan


def read_launch_text(
    text: str,
    /,
    *,
    name: str,
    packages: PackageFinder,
    report: Diagnostics,
    arguments: Mapping[str, str] | None = None,
    env: Mapping[str, str] | None = None,
) -> LaunchPlan:
    """Read a launch file's text; `name` is its name in messages.

    Raises:
        DescriptionError: as `read_launch`.
    """
    texts = [(name, text)]
    return read_launch([], packages=packages, report=report, arguments=arguments, env=env, texts=texts)


def read_arguments(
    file: Path,
    /,
    *,
    packages: PackageFinder,
    report: Diagnostics,
    arguments: Mapping[str, str] | None = None,
    env: Mapping[str, str] | None = None,
) -> tuple[LaunchArgument, ...]:
    """Read only the <arg>s that a launch file itself declares.

    Raises:
        DescriptionError: the file is not a launch file, or an <arg> is invalid.
    """
    command_line = CommandLine(arguments or {})
    reader = _Reader(packages=packages, report=report, env=env or {}, command_line=command_line)
    reader.read_declared(read_launch_file(file, Diagnostics()), file)
    return tuple(reader.builder.arguments)


class _Reader:
    """Reader of launch files into a plan builder."""

    def __init__(
        self,
        *,
        packages: PackageFinder,
        report: Diagnostics,
        env: Mapping[str, str],
        command_line: CommandLine,
        missing: MissingPackages | None = None,
        files: LaunchFiles | None = None,
    ) -> None:
        """Create a reader; with `missing` it collects missing packages and skips elements that cannot be read."""
        self.builder = PlanBuilder(report)
        self._report = report
        self._command_line = command_line
        self._collects_missing = missing is not None
        self._is_lenient = packages.is_lenient
        self._files = files or LaunchFiles()
        self._substitution = Substitution(
            packages=packages, env=env, anonymous=anonymous_name, missing=missing, files=self._files
        )

    def read_root(self, root: XmlNode, file: Path, namespace: str) -> None:
        """Read a file of the command line."""
        arguments = dict(self._command_line.arguments)
        scope = Scope(namespace=canonical_name(namespace) or "/", file=str(file), arguments=arguments)
        self._launch(root, scope, depth=0)

    def read_declared(self, root: XmlNode, file: Path) -> None:
        """Read the <arg>s of a file; required ones that are not set become ''."""
        scope = Scope(namespace="/", file=str(file), arguments=dict(self._command_line.arguments))
        for node in _launch_of(root).all("arg"):
            self._arg(node, scope, scope, top=True)
            for name in scope.declared:
                scope.arguments.setdefault(name, "")

    def _launch(self, root: XmlNode, scope: Scope, *, depth: int) -> None:
        root = _launch_of(root)
        if depth == 0 or scope.lenient_arguments:
            self._command_line.apply_to(root)
        self.builder.add_file(Path(scope.file))
        for name in root.attributes():
            if name != "deprecated":
                self._report.warn(
                    root.at, f"attribute {name!r} of <launch> is not known; it is ignored", "unsupported-attribute"
                )
        if deprecated := root.attribute("deprecated"):
            self._report.warn(root.at, f"deprecated: {deprecated}", "launch-deprecated")
        self._children(root, scope, depth=depth)

    def _attributes(self, node: XmlNode, scope: Scope, *known: str) -> Attributes:
        return Attributes(node, scope, self._substitution, self._report, known)

    def _children(self, parent: XmlNode, scope: Scope, *, depth: int) -> None:
        for node in parent.children:
            try:
                self._child(node, scope, depth=depth)
            except MissingPackageError as error:
                if self._is_lenient:
                    self._report.warn(error.at, f"{error.what}; {element_name(node)} is left out", error.id)
                elif not self._collects_missing:
                    raise
            except DescriptionError as error:
                if not self._collects_missing or isinstance(error, ReadBudgetError):
                    raise

    def _child(self, node: XmlNode, scope: Scope, *, depth: int) -> None:
        match node.tag:
            case "arg":
                self._arg(node, scope, scope, top=depth == 0)
            case "group":
                self._group(node, scope, depth=depth)
            case "include":
                self._include(node, scope, depth=depth)
            case "node" | "test":
                read_node(node, scope, self._substitution, self.builder, self._report)
            case "param":
                attributes = self._attributes(node, scope, "name", "value", "type", "textfile", "binfile", "command")
                if attributes.is_active:
                    name, value = read_param(attributes)
                    if name.startswith("~"):
                        scope.set_private_param(name[1:], (value, node.at))
                    else:
                        self.builder.set_param(scope.join(name), value, node.at)
            case "rosparam":
                read_rosparam(node, scope, self._substitution, self.builder, self._report)
            case "remap":
                read_remap(node, scope, scope, self._substitution, self._report)
            case "env":
                read_env(node, scope, scope, self._substitution, self._report)
            case "machine":
                read_machine(node, scope, self._substitution, self.builder, self._report)
            case "launch":
                raise DescriptionError(node.at, "<launch> within <launch>; a file has one", "wrong-root")
            case "master":
                self._report.warn(node.at, "<master> has no effect since ROS 0.7; it is ignored", "unsupported-element")
            case tag:
                self._report.warn(
                    node.at, f"<{tag}> is not a tag of launch files; it is ignored", "unsupported-element"
                )

    def _group(self, node: XmlNode, scope: Scope, *, depth: int) -> None:
        attributes = self._attributes(node, scope, "ns", "clear_params")
        if attributes.is_active:
            child = scope.child(attributes.namespace())
            if attributes.flag("clear_params"):
                self._clear(attributes, child)
            self._children(node, child, depth=depth)

    def _clear(self, attributes: Attributes, scope: Scope) -> None:
        if attributes.text("ns") is None:
            raise DescriptionError(
                attributes.at, "clear_params needs the attribute 'ns', which names what to clear", "missing-attribute"
            )
        self.builder.clear(scope.namespace)

    def _arg(self, node: XmlNode, scope: Scope, target: Scope, *, top: bool = False) -> None:
        """Declare an argument in `target`; its value is resolved in `scope`."""
        attributes = self._attributes(node, scope, "name", "value", "default", "doc")
        if not attributes.is_active:
            return
        name = attributes.required("name")
        value, default = attributes.text("value"), attributes.text("default")
        if value is not None and default is not None:
            raise DescriptionError(
                node.at, f"argument {name!r}: either 'value' or 'default', not both", "launch-conflict"
            )
        if name in target.declared and not target.lenient_arguments:
            raise DescriptionError(node.at, f"argument {name!r} is declared twice", "duplicate-name")
        target.declared.add(name)
        if top:
            required = value is None and default is None
            doc = attributes.text("doc") or ""
            self.builder.arguments.append(LaunchArgument(name=name, default=default, doc=doc, required=required))
        if value is not None:
            if name in target.arguments and not target.lenient_arguments:
                raise DescriptionError(
                    node.at, f"argument {name!r} has a fixed value, {value!r}; it cannot be set", "launch-arg"
                )
            target.arguments[name] = value
        elif default is not None:
            target.arguments.setdefault(name, default)

    def _include(self, node: XmlNode, scope: Scope, *, depth: int) -> None:
        attributes = self._attributes(node, scope, "file", "ns", "clear_params", "pass_all_args")
        if not attributes.is_active:
            return
        file = attributes.required("file")
        if depth >= _MAX_INCLUDE_DEPTH:
            raise DescriptionError(
                node.at, f"{file!r} is included {depth} levels deep; it may include itself", "include-cycle"
            )
        pass_all = attributes.flag("pass_all_args")
        passed = scope.included(attributes.namespace(), file, scope.arguments.items() if pass_all else ())
        passed.lenient_arguments = pass_all
        if attributes.flag("clear_params"):
            self._clear(attributes, passed)
        for child in node.children:
            match child.tag.lower():
                case "arg":
                    self._arg(child, scope, passed)
                case "env":
                    read_env(child, scope, passed, self._substitution, self._report)
                case _:
                    self._report.warn(
                        child.at, f"<{child.tag}> in <include> is not known; it is ignored", "unsupported-element"
                    )
        for name in sorted(passed.declared - set(passed.arguments)):
            raise DescriptionError(node.at, f"argument {name!r} is passed to {file!r} without a value", "launch-arg")
        passed_names = passed.declared
        passed.declared = set()
        self._files.check(file, node.at)
        self._substitution.refuse_absent(file, node.at)
        if not os.path.exists(file):
            raise DescriptionError(node.at, f"no launch file {file!r} to include", "missing-file")
        try:
            root = read_launch_file(Path(file), self._report, self._files.budget, node.at)
            self._launch(root, passed, depth=depth + 1)
        except DescriptionError as error:
            trace = f"; included at {node.at}"
            if depth >= _MAX_INCLUDES_IN_ERROR or error.what.endswith(trace):
                raise
            raise type(error)(error.at, error.what + trace, error.id) from None
        if unused := sorted(passed_names - passed.declared):
            known = ", ".join(map(repr, sorted(passed.declared))) or "none"
            raise DescriptionError(
                node.at, f"{file!r} has no argument {unused[0]!r}; its arguments: {known}", "unknown-argument"
            )


def _launch_of(root: XmlNode) -> XmlNode:
    """Return the <launch> element of a file, at any depth, as roslaunch does."""
    if root.tag == "launch":
        return root
    launches: list[XmlNode] = []
    pending = [root]
    while pending:
        node = pending.pop()
        pending += node.children
        launches += [node] if node.tag == "launch" else []
    if len(launches) != 1:
        raise DescriptionError(root.at, f"a launch file starts with <launch>, not <{root.tag}>", "wrong-root")
    return launches[0]

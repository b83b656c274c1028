"""References of plugins, nodes and controllers: parameters, topics and services, generated from the catalogs."""

import importlib
import inspect
from collections.abc import Iterable, Mapping
from types import FunctionType

from trundle.gazebo.nodes import BUILTIN_NODES
from trundle.gazebo.nodes.catalog import NODELETS
from trundle.gazebo.plugins import BUILTIN, SENSOR_PLUGINS, plugin_documentation
from trundle.gazebo.plugins.ros_control.catalog import CONTROLLERS

from .declarations import Declarations, Parameter
from .markdown import cell, code, html, table

_PLUGINS = """# Plugins

A `<plugin filename="…">` is found by its file name, in any folder.
Parameters have Gazebo's names; a parameter that is not read is a warning with file and line
([`unsupported-element`](diagnostics.md#unsupported-element)).
Most plugins also read `<robotNamespace>`, the namespace of their topics.
A plugin that is not listed can be [written in Python](../howto/plugin.md).
[Decision 14]({decision}) explains intended differences from the original plugins.

A topic in parentheses is the value of the parameter; `<word>` is computed when the plugin starts, and `…` is a default
that depends on others.
"""
_NODES = """# Nodes that run without ROS

A `<node pkg="…" type="…">` of a launch file is, in this order: an executable in the package's folder, one of the nodes
below, or a warning that names the missing node ([`missing-node`](diagnostics.md#missing-node)).
`trundle exec PACKAGE TYPE` runs a single node. Parameters are private ones (`~name`); a topic in parentheses is the
value of the parameter, `<word>` is computed when the node starts, and `…` is a default that depends on others.
"""
_CONTROLLERS = """# Controllers

`libgazebo_ros_control.so` runs these controllers of ros_control. A controller is loaded by its name, by
`controller_manager/spawner` in a launch file; its parameters and topics are below that name.
[Decision 14]({decision}) explains intended differences from the originals.
"""
_DECISION = "../decisions/0014-where-plugins-and-controllers-are-not-the-originals.md"


def plugins_page() -> str:
    """Return the page of model, world and sensor plugins."""
    parts = [_PLUGINS.format(decision=_DECISION), "## Models and worlds\n", *_sections(BUILTIN)]
    return "\n".join([*parts, "## Sensors\n", *_sections(SENSOR_PLUGINS)])


def nodes_page() -> str:
    """Return the page of executables and nodelets."""
    nodes = {f"{package}/{type_}": target for (package, type_), target in BUILTIN_NODES.items()}
    return "\n".join([_NODES, "## Executables\n", *_sections(nodes), "## Nodelets\n", *_sections(NODELETS)])


def controllers_page() -> str:
    """Return the page of ros_control's controllers."""
    return "\n".join([_CONTROLLERS.format(decision=_DECISION), *_sections(CONTROLLERS)])


def _sections(targets: Mapping[str, str]) -> Iterable[str]:
    """Yield a section for each implementation, with all its names."""
    names: dict[str, list[str]] = {}
    for name, target in targets.items():
        names.setdefault(target, []).append(name)
    for target, group in names.items():
        implementation = load(target)
        yield f"### `{group[0]}`\n"
        if len(group) > 1:
            yield f"Also {', '.join(f'`{name}`' for name in group[1:])}.\n"
        yield f"{cell(_summary(implementation))}\n"
        declared = Declarations(implementation)
        documentation = plugin_documentation(group[0])
        for documented in documentation.parameters if documentation is not None else ():
            if not declared.names_parameter(documented.name):  # read by a name that is computed
                declared.add(Parameter(documented.name, "", documented.default))
        parameters = [(code(p.name), html(p.type), _default(p.default)) for p in declared.parameters.values()]
        if parameters:
            yield table(("parameter", "type", "default"), parameters)
        endpoints = [(html(e.kind), code(e.name), code(e.type)) for e in declared.endpoints]
        if endpoints:
            yield table(("", "topic, service or action", "type"), endpoints)


def load(target: str) -> type | FunctionType:
    """Return the object of "module:name"."""
    module_name, _, attribute = target.partition(":")
    return getattr(importlib.import_module(module_name), attribute)


def _default(default: str | None) -> str:
    if default is None:
        return "required"
    return code(default) if default else "none"


def _summary(implementation: object) -> str:
    return (inspect.getdoc(implementation) or "").split("\n\n")[0]

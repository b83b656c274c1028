"""The references of plugins and nodes, from the catalogs."""

import importlib
import inspect
from collections.abc import Iterable, Mapping
from types import FunctionType

from trundle.gazebo.nodes import BUILTIN_NODES
from trundle.gazebo.nodes.catalog import NODELETS
from trundle.gazebo.plugins import BUILTIN, SENSOR_PLUGINS

from .markdown import cell

_PLUGINS = """# Plugins

A `<plugin filename="…">` is found by its file name, whatever folder stands before it.
Parameters are Gazebo's, by Gazebo's names; one that is not read is named with file and line.
A plugin that is not here can be [written in Python](../howto/plugin.md).
Where a plugin on purpose does not do what the original does, [decision 14]({decision}) says why.
"""
_NODES = """# Nodes that run without ROS

A `<node pkg="…" type="…">` of a launch file is, in this order: an executable in the package's folder, one of the nodes
below, or a warning that names what is missing.
`trundle exec PACKAGE TYPE` runs one by itself.
"""


def plugins_page() -> str:
    """Model and world plugins, and sensor plugins."""
    decision = "../decisions/0014-where-plugins-and-controllers-are-not-the-originals.md"
    return "\n".join(
        [
            _PLUGINS.format(decision=decision),
            "## Of models and worlds\n",
            *_table("file name", BUILTIN),
            "\n## Of sensors\n",
            *_table("file name", SENSOR_PLUGINS),
            "",
        ]
    )


def nodes_page() -> str:
    """Executables and nodelets."""
    nodes = {f"{package}/{type_}": target for (package, type_), target in BUILTIN_NODES.items()}
    return "\n".join(
        [
            _NODES,
            "## Executables\n",
            *_table("package/type", nodes),
            "\n## Nodelets\n",
            *_table("class", NODELETS),
            "",
        ]
    )


def _table(first: str, targets: Mapping[str, str]) -> Iterable[str]:
    yield f"| {first} | what it does | file |"
    yield "|---|---|---|"
    for name, target in targets.items():
        module_name, _, attribute = target.partition(":")
        found = getattr(importlib.import_module(module_name), attribute)
        yield f"| `{name}` | {_summary(found)} | `{_file(found)}` |"


def _summary(found: object) -> str:
    return cell((inspect.getdoc(found) or "").split("\n\n")[0])


def _file(found: type | FunctionType) -> str:
    return f"{inspect.unwrap(found).__module__.replace('.', '/')}.py".removeprefix("trundle/")

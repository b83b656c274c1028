"""References of plugins and nodes, generated from the catalogs."""

import importlib
import inspect
from collections.abc import Iterable, Mapping
from types import FunctionType

from trundle.gazebo.nodes import BUILTIN_NODES
from trundle.gazebo.nodes.catalog import NODELETS
from trundle.gazebo.plugins import BUILTIN, SENSOR_PLUGINS

from .markdown import cell

_PLUGINS = """# Plugins

A `<plugin filename="…">` is found by its file name, in any folder.
Parameters have Gazebo's names; a parameter that is not read is a warning with file and line.
A plugin that is not listed can be [written in Python](../howto/plugin.md).
[Decision 14]({decision}) explains intended differences from the original plugins.
"""
_NODES = """# Nodes that run without ROS

A `<node pkg="…" type="…">` of a launch file is, in this order: an executable in the package's folder, one of the nodes
below, or a warning that names the missing node.
`trundle exec PACKAGE TYPE` runs a single node.
"""


def plugins_page() -> str:
    """Return the page of model, world and sensor plugins."""
    decision = "../decisions/0014-where-plugins-and-controllers-are-not-the-originals.md"
    return "\n".join(
        [
            _PLUGINS.format(decision=decision),
            "## Models and worlds\n",
            *_table("file name", BUILTIN),
            "\n## Sensors\n",
            *_table("file name", SENSOR_PLUGINS),
            "",
        ]
    )


def nodes_page() -> str:
    """Return the page of executables and nodelets."""
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
    yield f"| {first} | description | file |"
    yield "|---|---|---|"
    for name, target in targets.items():
        module_name, _, attribute = target.partition(":")
        implementation = getattr(importlib.import_module(module_name), attribute)
        yield f"| `{name}` | {_summary(implementation)} | `{_file(implementation)}` |"


def _summary(implementation: object) -> str:
    return cell((inspect.getdoc(implementation) or "").split("\n\n")[0])


def _file(implementation: type | FunctionType) -> str:
    return f"{inspect.unwrap(implementation).__module__.replace('.', '/')}.py".removeprefix("trundle/")

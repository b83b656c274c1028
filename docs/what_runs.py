"""Writes the README's table of what runs, from the code's own catalogs."""

import sys
from collections.abc import Iterable
from pathlib import Path

from trundle.cli.main import COMMANDS
from trundle.nodes import BUILTIN_NODES
from trundle.plugins import BUILTIN, SENSOR_PLUGINS
from trundle.sensors import SIMULATED_CAMERAS

README = Path(__file__).parents[1] / "README.md"
BEGIN = "<!-- what runs: begin (made by `make format` from the code's catalogs) -->"
END = "<!-- what runs: end -->"
GAZEBO_ROS = "gazebo_ros_"


def table() -> str:
    """The rows: commands, nodes, sensors, plugins; a name's other spellings are left out."""
    plugins = {name.removeprefix("lib").removesuffix(".so") for name in {*BUILTIN, *SENSOR_PLUGINS}}
    of_ros = {name for name in plugins if name.startswith(GAZEBO_ROS)}
    rows = {
        "`trundle …`": _listed(COMMANDS),
        "nodes without ROS": _listed(_nodes()),
        "sensors": _listed(sorted(SIMULATED_CAMERAS)),
        "Gazebo's plugins": f"{_listed(sorted(plugins - of_ros))}, your own in Python",
        f"`{GAZEBO_ROS}…` plugins": _listed(sorted(name.removeprefix(GAZEBO_ROS) for name in of_ros)),
    }
    lines = [f"| {kind} | {names} |" for kind, names in rows.items()]
    return "\n".join(["| | |", "|---|---|", *lines])


def _nodes() -> list[str]:
    """Each package with its types as a shell would put them; `driver.py` is not told apart from a `driver`."""
    types: dict[str, list[str]] = {}
    for package, type_ in sorted(BUILTIN_NODES):
        if not type_.endswith(".py") or (package, type_.removesuffix(".py")) not in BUILTIN_NODES:
            types.setdefault(package, []).append(type_)
    return [
        f"{package}/{{{','.join(own)}}}" if len(own) > 1 else package if own == [package] else f"{package}/{own[0]}"
        for package, own in types.items()
    ]


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def renewed(readme: str) -> str:
    """The README with the table as it is now."""
    head, _, rest = readme.partition(BEGIN)
    _, _, tail = rest.partition(END)
    return f"{head}{BEGIN}\n{table()}\n{END}{tail}"


if __name__ == "__main__":
    README.write_text(renewed(README.read_text()))
    sys.exit(0)

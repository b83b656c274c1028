"""Writes the README's table of what runs, from the code's own catalogs."""

import sys
from pathlib import Path

from trundle.cli.main import COMMANDS
from trundle.nodes import STAND_INS
from trundle.plugins import BUILTIN, OF_SENSORS
from trundle.sensors import SIMULATED

README = Path(__file__).parents[1] / "README.md"
BEGIN = "<!-- what runs: begin (made by `make format` from the code's catalogs) -->"
END = "<!-- what runs: end -->"


def table() -> str:
    """The rows: commands, nodes, sensors, plugins."""
    rows = {
        "commands": [f"`trundle {name}`" for name in COMMANDS],
        "nodes without ROS": [f"`{package}/{type_}`" for package, type_ in sorted(STAND_INS)],
        "sensors": [f"`{name}`" for name in sorted(SIMULATED)],
        "Gazebo plugins": [*(f"`{name}`" for name in sorted({*BUILTIN, *OF_SENSORS})), "your own, in Python"],
    }
    lines = [f"| {kind} | {', '.join(names)} |" for kind, names in rows.items()]
    return "\n".join(["| | |", "|---|---|", *lines])


def renewed(readme: str) -> str:
    """The README with the table as it is now."""
    head, _, rest = readme.partition(BEGIN)
    _, _, tail = rest.partition(END)
    return f"{head}{BEGIN}\n{table()}\n{END}{tail}"


if __name__ == "__main__":
    README.write_text(renewed(README.read_text()))
    sys.exit(0)

"""Table of docs/sensors.md, generated from the code; as a program it rewrites the page."""

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from trundle.ros.bridge import SENSOR_TOPICS

PAGE = Path(__file__).parents[1] / "sensors.md"
_HEAD = '| `<sensor type="…">` | topic | message |'


def table() -> str:
    """Return one row per topic; types with the same topics share rows."""
    return "\n".join([_HEAD, "|---|---|---|", *_rows()])


def with_table(page: str) -> str:
    """Return the page with its table regenerated."""
    before, _, rest = page.partition(_HEAD)
    _, _, after = rest.partition("\n\n")
    return f"{before}{table()}\n\n{after}"


def _rows() -> Iterator[str]:
    for outputs, types in groupby(SENSOR_TOPICS, key=lambda type_: SENSOR_TOPICS[type_]):
        names = list(types)
        alone = [name for name in names if name == "multicamera"]
        for group in ([name for name in names if name not in alone], alone):
            first = ", ".join(f"`{name}`" for name in group)
            for output in outputs if group else ():
                topic = f"<camera>/{output.name}" if group is alone else output.name
                only = f": {output.condition.text}" if output.condition is not None and output.condition.text else ""
                yield f"| {first} | `{topic}` | `{output.type}`{only} |".replace("|  |", "| |")
                first = ""


if __name__ == "__main__":
    PAGE.write_text(with_table(PAGE.read_text()))

"""Elements and attributes of a format: type, unit, default and versions, from a table of its specification's facts."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent


class Spec(NamedTuple):
    """Row of a specification."""

    path: str
    """Elements separated by `/`; an attribute follows `@`."""
    type: str = ""
    """Empty: an element that holds others."""
    unit: str = ""
    default: str = ""
    since: str = ""
    until: str = ""
    """Last version that has it; empty: the newest one does."""
    earlier: str = ""
    """Defaults of earlier versions."""
    meaning: str = ""

    @property
    def section(self) -> str:
        """Outermost element."""
        return self.path.partition("/")[0].partition("@")[0]

    @property
    def element(self) -> str:
        """Path of the element, without the attribute."""
        return self.path.partition("@")[0]

    @property
    def attribute(self) -> str:
        """Name of the attribute; empty for an element."""
        return self.path.partition("@")[2]


def read_spec(kind: str) -> list[Spec]:
    """Return the rows of `{kind}_spec.tsv`, in the order of the file."""
    return list(_rows(HERE / f"{kind}_spec.tsv"))


def _rows(file: Path) -> Iterator[Spec]:
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
    names = [name.replace("earlier defaults", "earlier") for name in lines[0].split("\t")]
    for line in lines[1:]:
        yield Spec(**dict(zip(names, line.split("\t"), strict=False)))

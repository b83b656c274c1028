"""What comes with Trundle to be run, with a sentence about each file: `trundle run --list`."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from trundle.assets import ASSETS
from trundle.base.files import read_text

from .gazebo_paths import CHECKOUT_EXAMPLES

PLANS = ASSETS / "plans"
_EXAMPLES = [*CHECKOUT_EXAMPLES, ASSETS / "models", ASSETS / "ros_packages"]
_COMMENT = re.compile(r"<!--\s*(.*?)\s*-->", re.DOTALL)
_DESCRIPTION = re.compile(r"<description>\s*(.*?)\s*</description>", re.DOTALL)
_FIRST_LINE = re.compile(r"#\s*(.*)")


class ShippedFile(NamedTuple):
    """World, model, launch file or plan of Trundle."""

    kind: str
    """Worlds, launch files, models or plans."""
    command: str
    """Command that runs it."""
    about: str
    """What it is: the first comment of the file, or the description of model.config."""


def shipped_files() -> list[ShippedFile]:
    """Return all worlds, models and plans, and the launch files that begin with a comment, by kind and name."""
    return [*_worlds(), *_launch_files(), *_models(), *_plans()]


def _worlds() -> Iterator[ShippedFile]:
    own = ASSETS / "worlds"
    for folder in (own, *(folder for root in (own, *CHECKOUT_EXAMPLES) for folder in [root / "physics"])):
        prefix = "" if folder == own else f"{folder.name}/"
        for path in sorted(folder.glob("*.world")):
            yield ShippedFile("worlds", f"trundle run {prefix}{path.name}", _about(path, _COMMENT))


def _launch_files() -> Iterator[ShippedFile]:
    for path in _sorted("*/launch/*.launch"):
        if about := _about(path, _COMMENT):
            yield ShippedFile("launch files", f"trundle launch {path.parent.parent.name} {path.name}", about)


def _models() -> Iterator[ShippedFile]:
    for path in _sorted("*/model.config"):
        yield ShippedFile("models", f"trundle run model://{path.parent.name}", _about(path, _DESCRIPTION))


def _plans() -> Iterator[ShippedFile]:
    for path in sorted(PLANS.glob("*.yaml")):
        yield ShippedFile("plans", f"trundle sweep {path.name}", _about(path, _FIRST_LINE))


def _sorted(pattern: str) -> list[Path]:
    return sorted((path for root in _EXAMPLES for path in root.glob(pattern)), key=lambda path: path.parts[-3:])


def _about(path: Path, pattern: re.Pattern[str]) -> str:
    found = pattern.search(read_text(path))
    return "" if found is None else " ".join(found[1].split())

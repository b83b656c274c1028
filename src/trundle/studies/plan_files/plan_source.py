"""Text of a plan, from its file or from a dictionary."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import yaml

from trundle.base.diagnostics import UsageError
from trundle.robots.packages import PLANS

from .yaml_node import YamlNode


class PlanSource(NamedTuple):
    """Text of a plan."""

    text: str
    """YAML text."""
    file: str
    """Name of the file in messages."""
    folder: Path
    """Base of relative paths."""


def read_source(plan: "str | os.PathLike[str] | Mapping[str, object]") -> PlanSource:
    """Read a plan's file, else Trundle's plan of that name, or convert a dictionary to YAML.

    Paths of a plan of Trundle are relative to the working directory, where its results are, too.

    Raises:
        UsageError: the file cannot be read.
    """
    if isinstance(plan, Mapping):
        return PlanSource(yaml.safe_dump(dict(plan), sort_keys=False), "plan", Path.cwd())
    file = Path(plan)
    shipped = PLANS / file
    path = shipped if file.name == str(file) and not file.exists() and shipped.is_file() else file
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise UsageError(f"{file}: {error.strerror}; give the YAML file of a plan") from None
    except UnicodeDecodeError:
        raise UsageError(f"{file}: not a text; give the YAML file of a plan") from None
    return PlanSource(text, str(file), file.resolve().parent)


def description_path(node: YamlNode, folder: Path, label: str) -> str:
    """Return the name of a world or model; a path is relative to the plan.

    Raises:
        DescriptionError: the value is not a text.
    """
    name = node.text(label)
    path = folder / name
    return str(path) if "://" not in name and os.path.exists(path) else name

"""What of an rviz configuration the page can show."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias, cast

import yaml

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.files import read_text
from trundle.model import Rgba
from trundle.yaml_loader import BoundedLoader

DisplayKind: TypeAlias = Literal["Grid", "Image", "Odometry", "RobotModel", "TF"]
_TOPIC_KEYS: dict[str, tuple[str, ...]] = {
    "Image": ("Image Topic", "Topic"),
    "Camera": ("Image Topic", "Topic"),
    "Odometry": ("Topic",),
    "RobotModel": ("Robot Description",),
}
_KINDS: dict[str, DisplayKind] = {
    "Grid": "Grid",
    "RobotModel": "RobotModel",
    "TF": "TF",
    "Odometry": "Odometry",
    "Image": "Image",
    "Camera": "Image",
}
_PREFIXES = ("rviz/", "rviz_default_plugins/", "rviz_common/")
_BACKGROUND: Rgba = (48 / 255, 48 / 255, 48 / 255, 1.0)
"""rviz's own default, 48; 48; 48."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RvizDisplay:
    """One entry of rviz's list of displays."""

    kind: DisplayKind
    name: str
    enabled: bool = True
    source: str | None = None
    """The topic of Odometry and Image, the parameter of RobotModel; None where the file names none."""
    show_names: bool = True
    """TF: names beside the axes."""
    collisions: bool = False
    """RobotModel: collision shapes too."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RvizConfig:
    """What to show, and in which frame."""

    fixed_frame: str | None = None
    """None where no file says: take `choose_fixed_frame`."""
    displays: tuple[RvizDisplay, ...] = ()
    background: Rgba = _BACKGROUND

    def enabled(self, kind: DisplayKind) -> tuple[RvizDisplay, ...]:
        """Return the displays of a kind that are switched on."""
        return tuple(display for display in self.displays if display.kind == kind and display.enabled)


DEFAULT_CONFIG = RvizConfig(
    displays=(
        RvizDisplay(kind="Grid", name="Grid"),
        RvizDisplay(kind="RobotModel", name="RobotModel", source="robot_description"),
        RvizDisplay(kind="TF", name="TF"),
        RvizDisplay(kind="Odometry", name="Odometry", source="odom"),
    )
)
"""What a person wants to see who has no configuration: the robot, its frames, and where it drives."""


def choose_fixed_frame(config: RvizConfig, frames: Iterable[str]) -> str:
    """Return the configured frame, else one in which a robot is seen to drive, else the robot's own."""
    if config.fixed_frame is not None:
        return config.fixed_frame
    known = list(frames)
    for name in ("odom", "map", "world", "base_footprint", "base_link"):
        if name in known:
            return name
    return known[0] if known else "base_link"


def read_rviz_config(path: Path | None, report: Diagnostics) -> RvizConfig:
    """Read an .rviz file; a path of None, a missing file or one of before 2012 (.vcg) means `DEFAULT_CONFIG`.

    Raises:
        DescriptionError: the file is no YAML, or no rviz configuration.
    """
    if path is None:
        return DEFAULT_CONFIG
    here = Source(str(path))
    if not os.path.exists(path):
        report.warn(here, "no such rviz configuration; showing the robot, its frames and its path")
        return DEFAULT_CONFIG
    if path.suffix == ".vcg":
        report.warn(here, "rviz configurations of before Groovy (.vcg) are not supported; showing the usual displays")
        return DEFAULT_CONFIG
    try:
        root = yaml.compose(read_text(path), Loader=BoundedLoader)
    except OSError as error:
        raise DescriptionError(here, f"cannot be read: {error.strerror}") from None
    except yaml.MarkedYAMLError as error:
        line = None if error.problem_mark is None else error.problem_mark.line + 1
        raise DescriptionError(Source(str(path), line), f"not YAML: {error.problem or error}") from None
    except yaml.YAMLError as error:
        raise DescriptionError(here, f"not YAML: {error}") from None
    manager = _child(root, "Visualization Manager")
    if manager is None:
        raise DescriptionError(here, "not an rviz configuration: it has no 'Visualization Manager'")
    options = _child(manager, "Global Options")
    return RvizConfig(
        fixed_frame=_text(options, "Fixed Frame", "").lstrip("/") or None,
        background=_color(_text(options, "Background Color", "")),
        displays=tuple(_read_displays(_child(manager, "Displays"), str(path), report)),
    )


def _read_displays(node: yaml.Node | None, file: str, report: Diagnostics) -> list[RvizDisplay]:
    """Read a list of displays; groups are flattened, and switch off what they hold when they are off."""
    displays: list[RvizDisplay] = []
    named: set[str] = set()
    for item, enabled in _flattened(node, enabled=True):
        written = _text(item, "Class", "")
        short = written
        for prefix in _PREFIXES:
            short = short.removeprefix(prefix)
        if short not in _KINDS:
            if enabled and written not in named:
                named.add(written)
                at = Source(file, item.start_mark.line + 1)
                report.warn(at, f"rviz display '{written}' is not supported yet; the page leaves it out")
            continue
        displays.append(
            RvizDisplay(
                kind=_KINDS[short],
                name=_text(item, "Name", short),
                enabled=enabled,
                source=_source(item, short),
                show_names=_truth(item, "Show Names", default=True),
                collisions=_truth(item, "Collision Enabled", default=False),
            )
        )
    return displays


def _flattened(node: yaml.Node | None, *, enabled: bool) -> Iterable[tuple[yaml.Node, bool]]:
    if not isinstance(node, yaml.SequenceNode):
        return
    for item in cast(list[yaml.Node], node.value):
        # Enabled is a copy of Value; files written by hand have either.
        on = enabled and _truth(item, "Enabled", default=_truth(item, "Value", default=True))
        if _text(item, "Class", "").endswith("/Group"):
            yield from _flattened(_child(item, "Displays"), enabled=on)
        else:
            yield item, on


def _source(item: yaml.Node, short: str) -> str | None:
    for key in _TOPIC_KEYS.get(short, ()):
        value = _child(item, key)
        if isinstance(value, yaml.MappingNode):  # ROS 2 writes {Depth, Reliability Policy, …, Value}
            value = _child(value, "Value")
        if isinstance(value, yaml.ScalarNode) and value.value:
            return str(value.value)
    return None


def _child(node: yaml.Node | None, key: str) -> yaml.Node | None:
    if isinstance(node, yaml.MappingNode):
        for name, value in cast(list[tuple[yaml.Node, yaml.Node]], node.value):
            if isinstance(name, yaml.ScalarNode) and name.value == key:
                return value
    return None


def _text(node: yaml.Node | None, key: str, default: str) -> str:
    value = _child(node, key)
    return str(value.value) if isinstance(value, yaml.ScalarNode) else default


def _truth(node: yaml.Node | None, key: str, *, default: bool) -> bool:
    return _text(node, key, str(default)).lower() in ("true", "1", "yes", "on")


def _color(text: str) -> Rgba:
    """Read rviz's `r; g; b` of 0 to 255; anything else is rviz's default."""
    try:
        red, green, blue = (min(max(float(part) / 255, 0.0), 1.0) for part in text.split(";"))
    except ValueError:
        return _BACKGROUND
    return (red, green, blue, 1.0)

"""`trundle check` of a robot, a model or a world."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.robots.description import LoadedDescription
from trundle.robots.lint.description_lint import lint_description
from trundle.robots.lint.empty_scene import empty_reason
from trundle.robots.lint.physics_precheck import physics_accepts
from trundle.robots.load_input import Piped, load_input
from trundle.robots.model import Model, World, flattened
from trundle.robots.names import is_legal_base_name, ros_name
from trundle.robots.packages import Packages
from trundle.sim.physics import report_wheels

from ..model_plugins import report_missing_plugins

if TYPE_CHECKING:
    from trundle.base.drawing.tree import TreeNode


@dataclass(frozen=True, slots=True)
class DescriptionFindings:
    """Loaded description, and its world with nested models flattened."""

    loaded: LoadedDescription
    flat: World

    def as_json(self) -> dict[str, object]:
        """Return the contents, as `check --json` prints them."""
        from .json_output import description_json

        return description_json(self.loaded)

    def trees(self) -> "list[TreeNode]":
        """Return the kinematic tree of each model."""
        from .kinematic_tree import kinematic_trees

        return kinematic_trees(self.loaded)

    def sentence(self) -> str:
        """Return kind and counts, on one line."""
        models = self.flat.models
        links = sum(len(model.links) for model in models)
        joints = sum(len(model.joints) for model in models)
        sensors = sum(len(link.sensors) for model in models for link in model.links)
        kind = {"world": "a world", "model": "a model", "urdf": "a URDF"}[self.loaded.kind]
        version = f" (SDF {self.flat.sdf_version})" if self.flat.sdf_version else ""
        counts = f"{len(models)} models, {links} links, {joints} joints, {sensors} sensors"
        reason = empty_reason(self.flat)
        return f"{kind}{version}: {counts}{f'; {reason}' if reason else ''}"


def check_description(
    file: str,
    environment: Mapping[str, str],
    *,
    packages: Packages,
    start: Path,
    report: Diagnostics,
    collisions: bool = False,
    piped: Piped | None = None,
) -> DescriptionFindings:
    """Read a description, lint it and compile its physics.

    Args:
        file: argument of `trundle check`.
        environment: variables that locate plugins.
        packages: resolve URIs.
        start: folder for relative URIs in standard input.
        report: receives all findings.
        collisions: cut hollow meshes like physics, which may take a minute.
        piped: contents of `file` if it is a pipe.

    Raises:
        DescriptionError: the file cannot be read.
        UsageError: no such model.
    """
    loaded = load_input(file, report, packages=packages, start=start, piped=piped)
    flat = flattened(loaded.world)
    lint_description(loaded, report)
    _report_ros_names(flat, report)
    _report_silent_sensors(flat, report)
    report_missing_plugins(flat, environment, report)
    _report_physics(flat, report, collisions=collisions)
    return DescriptionFindings(loaded, flat)


def _report_physics(flat: World, report: Diagnostics, *, collisions: bool) -> None:
    try:
        if not physics_accepts(flat):
            from trundle.sim.physics import compile_world  # slow to load, and only few robots need it

            compile_world(flat, report, cut_meshes=collisions)
        report_wheels(flat, report)
    except DescriptionError as error:
        report.error(error)


def _report_silent_sensors(flat: World, report: Diagnostics) -> None:
    sensors = [sensor for model in flat.models for link in model.links for sensor in link.sensors]
    if not sensors:
        return
    from trundle.sim.sensors import SIMULATED_CAMERAS  # slow to load

    for sensor in sensors:
        if sensor.type not in SIMULATED_CAMERAS:
            report.warn(
                sensor.at, f"sensor {sensor.name!r}: {sensor.type} sensors are not simulated yet", "unsupported-sensor"
            )


def _report_ros_names(flat: World, report: Diagnostics) -> None:
    """Report illegal names of moving models, with their names on the graph and in tf."""
    for model in flat.models:
        if model.static:
            continue
        for name, at in _names_of(model):
            if not is_legal_base_name(name.replace("::", "_")):
                report.info(
                    at, f"{name!r} is not a legal ROS name; on the graph and in tf it is {ros_name(name)!r}", "ros-name"
                )


def _names_of(model: Model) -> Iterator[tuple[str, Source]]:
    yield model.name, model.at
    for part in (*model.links, *model.joints):
        yield part.name, part.at

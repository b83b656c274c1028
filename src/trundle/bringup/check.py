"""`trundle check`: what a file says, and what is doubtful about it; nothing in it is run."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from trundle.description import Loaded
from trundle.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.diagram import TreeNode
from trundle.launch import LaunchPlan, ParamCommand, read_launch
from trundle.model import flattened
from trundle.packages import Packages
from trundle.physics import compile_world
from trundle.sensors import SIMULATED

from .check_json import described, launch_described
from .described_file import load_described
from .doubts import name_doubts
from .kinematic_tree import kinematic_trees

_LAUNCH = (".launch", ".test")


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckOutcome:
    """What checking a file found."""

    file: str
    loaded: Loaded | LaunchPlan | None
    """None: the file was refused."""
    report: Diagnostics

    def trees(self) -> list[TreeNode]:
        """The kinematic trees of what was understood; none of a launch file."""
        return kinematic_trees(self.loaded) if isinstance(self.loaded, Loaded) else []

    @property
    def refused(self) -> bool:
        """Whether nothing sensible could be made of the file."""
        return self.loaded is None

    def as_json(self) -> dict[str, object]:
        """The resolved description and every finding."""
        findings = [finding.as_json() for finding in self.report.findings]
        if self.loaded is None:
            return {"kind": None, "models": [], "diagnostics": findings}
        if isinstance(self.loaded, LaunchPlan):
            return {**launch_described(self.loaded), "diagnostics": findings}
        return {**described(self.loaded), "diagnostics": findings}

    def text(self) -> str:
        """Findings, worst first, and what was understood."""
        lines = [str(finding) for finding in self.report.worst_first()]
        counts = Counter(finding.severity for finding in self.report.findings)
        plural = {"error": "errors", "warning": "warnings", "info": "notes"}
        singular = {"error": "error", "warning": "warning", "info": "note"}
        told = [f"{n} {(singular if n == 1 else plural)[s]}" for s in plural if (n := counts[s])]
        verdict = "refused" if self.refused else _understood(self.loaded)
        return "\n".join([*lines, f"{self.file}: {verdict}; {', '.join(told) or 'nothing to remark'}"])


def check(file: str, environment: Mapping[str, str], *, start: Path) -> CheckOutcome:
    """Read a file as far as it can be read, physics included.

    Args:
        file: a path, a folder with model.config, model://NAME, a launch file, or "-" for standard input.
        environment: says where packages and models are.
        start: packages are looked for around it too.
    """
    report = Diagnostics()
    packages = Packages(environment, start=start)
    loaded: Loaded | LaunchPlan | None = None
    try:
        if file.endswith(_LAUNCH) and Path(file).is_file():
            around = packages.around(Path(file))
            loaded = read_launch(Path(file), packages=around, report=report, env=environment)
        else:
            loaded = load_described(file, report, packages=packages, start=start)
            _look_closer(loaded, report)
    except DescriptionError as error:
        loaded = None
        report.error(error)
    except UsageError as error:
        report.error(DescriptionError(Source(file), str(error)))
    return CheckOutcome(file=file, loaded=loaded, report=report)


def _look_closer(loaded: Loaded, report: Diagnostics) -> None:
    """What shows only when the description is put to use."""
    name_doubts(loaded, report)
    _name_silent_sensors(loaded, report)
    try:
        compile_world(flattened(loaded.world), report)
    except DescriptionError as error:
        report.error(error)


def _name_silent_sensors(loaded: Loaded, report: Diagnostics) -> None:
    for model in flattened(loaded.world).models:
        for link in model.links:
            for sensor in link.sensors:
                if sensor.type not in SIMULATED:
                    report.warn(sensor.at, f"sensor {sensor.name!r}: {sensor.type} sensors are not simulated yet")


def _understood(loaded: Loaded | LaunchPlan | None) -> str:
    if isinstance(loaded, LaunchPlan):
        commands = sum(isinstance(param.value, ParamCommand) for param in loaded.params)
        to_run = f", {commands} of them by a command" if commands else ""
        return f"a launch of {len(loaded.nodes)} nodes with {len(loaded.params)} parameters{to_run}"
    assert loaded is not None
    models = flattened(loaded.world).models
    links = sum(len(model.links) for model in models)
    joints = sum(len(model.joints) for model in models)
    sensors = sum(len(link.sensors) for model in models for link in model.links)
    what = {"world": "a world", "model": "a model", "urdf": "a URDF"}[loaded.kind]
    version = f" (SDF {loaded.world.sdf_version})" if loaded.world.sdf_version else ""
    return f"{what}{version}: {len(models)} models, {links} links, {joints} joints, {sensors} sensors"

"""Result of a run: the final state, and the speed."""

import itertools
from dataclasses import dataclass
from typing import NotRequired, TypedDict

from trundle.base.diagnostics import DiagnosticJson, Diagnostics
from trundle.robots.model import Joint, Link, Model, World
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, pose_from_row


class _LinkJson(TypedDict):
    name: str
    pose: list[float]
    twist: list[float]


class _JointJson(TypedDict):
    name: str
    position: float | list[float]
    velocity: float | list[float]
    effort: float | list[float]


class ModelJson(TypedDict):
    """One model's state as `run --json` prints it."""

    name: str
    pose: list[float]
    links: list[_LinkJson]
    joints: list[_JointJson]
    models: list["ModelJson"]
    added: NotRequired[bool]


class RunResultJson(TypedDict):
    """Output of `run --json`."""

    time: float
    steps: int
    wall: float
    rtf: float | None
    images: int
    models: list[ModelJson]
    diagnostics: list[DiagnosticJson]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunResult:
    """Final state and figures of a run."""

    world: World
    snapshot: Snapshot
    steps: int
    simulated_s: float
    """Simulated time of the whole run [s]; a reset rewinds the snapshot's time, not this."""
    wall_s: float
    images: int
    """Number of rendered camera images."""
    report: Diagnostics
    interrupted: bool
    """True if Ctrl-C or SIGTERM ended it."""
    recording_failed: bool

    @property
    def time_s(self) -> float:
        """Simulation time [s]."""
        return self.snapshot.time_ns / 1e9

    @property
    def real_time_factor(self) -> float | None:
        """Simulated over wall time, from the first step to the last."""
        return self.simulated_s / self.wall_s if self.wall_s > 0 else None

    def as_json(self) -> RunResultJson:
        """Final state as JSON; lists are in file order, poses and twists in the world frame."""
        return {
            "time": self.time_s,
            "steps": self.steps,
            "wall": round(self.wall_s, 6),
            "rtf": self.real_time_factor,
            "images": self.images,
            "models": self._models(),
            "diagnostics": [finding.as_json() for finding in self.report.findings],
        }

    def _models(self) -> list[ModelJson]:
        state = _State(self.snapshot)
        return [state.model(model, Pose())[0] for model in self.world.models]

    def summary(self) -> str:
        """Lines to print: time, speed, images, and the pose of each model that is not static."""
        factor = self.real_time_factor
        speed = "" if factor is None else f", {factor:.3g} times real time"
        spent = f"{self.simulated_s:.3f} s simulated in {self.wall_s:.2f} s{speed}"
        since = "" if self.simulated_s == self.time_s else f"; the last reset was {self.time_s:.3f} s ago"
        lines = [f"{spent}; {self.steps} steps, {self.images} images{since}"]
        for described, model in zip(self.world.models, self._models(), strict=True):
            if not described.static:
                x, y, z, roll, pitch, yaw = model["pose"]
                lines.append(
                    f"{model['name']} stands at x {x:.3f}, y {y:.3f}, z {z:.3f} m; "
                    f"roll {roll:.3f}, pitch {pitch:.3f}, yaw {yaw:.3f} rad"
                )
        return "\n".join(lines)


class _State:
    """Reader of a snapshot in the snapshot's order: a model's links and joints, then those of its nested models."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._link = itertools.count()
        self._joint = itertools.count()

    def model(self, model: Model, world_from_outer: Pose) -> tuple[ModelJson, Pose]:
        """State of a model, and its pose in the world."""
        links = [self._link_state(link) for link in model.links]
        joints = [self._joint_state(joint) for joint in model.joints]
        world_from_model = world_from_outer @ model.world_from_model
        if model.links:
            first = Pose.from_rpy(*links[0]["pose"])
            world_from_model = first @ model.links[0].model_from_link.inverse()
        nested = [self.model(inner, world_from_model) for inner in model.models]
        if nested and not model.links:  # the frame of a model without links follows its first nested model
            world_from_model = nested[0][1] @ model.models[0].world_from_model.inverse()
        entry: ModelJson = {
            "name": model.name,
            "pose": world_from_model.as_list(),
            "links": links,
            "joints": joints,
            "models": [state for state, _ in nested],
        }
        if model.added:
            entry["added"] = True
        return entry, world_from_model

    def _link_state(self, link: Link) -> _LinkJson:
        index = next(self._link)
        pose, twist = pose_from_row(self._snapshot.poses[index]), self._snapshot.twists[index]
        return {"name": link.name, "pose": pose.as_list(), "twist": [float(v) for v in twist]}

    def _joint_state(self, joint: Joint) -> _JointJson:
        index = next(self._joint)
        position, velocity, effort = map(_one_or_all, self._snapshot.axes_of(index))
        return {"name": joint.name, "position": position, "velocity": velocity, "effort": effort}


def _one_or_all(axes: list[float]) -> float | list[float]:
    """Return a number for a joint of at most one degree of freedom, else the list."""
    if len(axes) > 1:
        return axes
    return axes[0] if axes else 0.0

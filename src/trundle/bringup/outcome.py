"""Where a run ended: the final state and how fast it got there."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NotRequired, TypedDict

from trundle.diagnostics import DiagnosticJson, Diagnostics
from trundle.model import World
from trundle.simulation import Snapshot
from trundle.spatial import Pose


class _LinkJson(TypedDict):
    name: str
    pose: list[float]
    twist: list[float]


class _JointJson(TypedDict):
    name: str
    position: float
    velocity: float
    effort: float


class ModelJson(TypedDict):
    """One model's state as `run --json` prints it."""

    name: str
    pose: list[float]
    links: list[_LinkJson]
    joints: list[_JointJson]
    added: NotRequired[bool]


class OutcomeJson(TypedDict):
    """What `run --json` prints."""

    time: float
    steps: int
    wall: float
    rtf: float | None
    images: int
    models: list[ModelJson]
    diagnostics: list[DiagnosticJson]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """The end of a run."""

    world: World
    snapshot: Snapshot
    steps: int
    wall_s: float
    images: int
    """Camera pictures finished."""
    report: Diagnostics
    interrupted: bool
    """By Ctrl-C or SIGTERM."""

    @property
    def time_s(self) -> float:
        """Simulation time [s]."""
        return self.snapshot.time_ns / 1e9

    @property
    def real_time_factor(self) -> float | None:
        """Simulated over wall time, from the first step to the last."""
        return self.time_s / self.wall_s if self.wall_s > 0 else None

    def as_json(self) -> OutcomeJson:
        """The final state; lists are in file order, poses and twists in the world frame."""
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
        snapshot = self.snapshot
        link, joint = 0, 0
        models: list[ModelJson] = []
        for model in self.world.models:
            links: list[_LinkJson] = []
            for each in model.links:
                pose = pose_of(snapshot.poses[link])
                links.append(
                    {"name": each.name, "pose": pose.as_list(), "twist": [float(v) for v in snapshot.twists[link]]}
                )
                link += 1
            joints: list[_JointJson] = []
            for each in model.joints:
                joints.append(
                    {
                        "name": each.name,
                        "position": float(snapshot.joint_positions[joint]),
                        "velocity": float(snapshot.joint_velocities[joint]),
                        "effort": float(snapshot.joint_efforts[joint]),
                    }
                )
                joint += 1
            if model.links:
                first = pose_of(snapshot.poses[link - len(model.links)])
                pose = first @ model.links[0].model_from_link.inverse()
            else:
                pose = model.world_from_model
            entry: ModelJson = {"name": model.name, "pose": pose.as_list(), "links": links, "joints": joints}
            if model.added:
                entry["added"] = True
            models.append(entry)
        return models

    def summary(self) -> str:
        """A few lines for a person: time, speed, images, and where each robot stands."""
        factor = self.real_time_factor
        speed = "" if factor is None else f", {factor:.3g} times real time"
        lines = [
            f"{self.time_s:.3f} s simulated in {self.wall_s:.2f} s{speed}; {self.steps} steps, {self.images} images"
        ]
        for model in self._models():
            if "added" not in model:
                x, y, z, roll, pitch, yaw = model["pose"]
                lines.append(
                    f"{model['name']} stands at x {x:.3f}, y {y:.3f}, z {z:.3f} m; "
                    f"roll {roll:.3f}, pitch {pitch:.3f}, yaw {yaw:.3f} rad"
                )
        return "\n".join(lines)


def pose_of(row: Sequence[float]) -> Pose:
    """One row of `Snapshot.poses`, x y z qw qx qy qz, as a Pose."""
    x, y, z, qw, qx, qy, qz = map(float, row)
    return Pose((x, y, z), (qw, qx, qy, qz))

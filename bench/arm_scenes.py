"""Scenes and queries of an arm of seven joints: a table, a shelf, bins, and a window in a wall."""

from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.planning import _planning
from trundle.planning.planners import Constraints, OrientationConstraint, PositionConstraint
from trundle.planning.planners.group_problem import GroupProblem
from trundle.planning.planning_scene import CollisionObject, PlacedShape, PlanningScene
from trundle.planning.robot_model import RobotModel, robot_model
from trundle.robots.model import Box, Cylinder
from trundle.spatial import Pose, Quaternion, quaternion_from_rpy

GROUP = "arm"
SEGMENT_FRACTION = 0.005
_ARMS = Path(__file__).parents[1] / "tests/data/arms"
_LINKS = ("base_link", *(f"link_{i}" for i in range(1, 8)))
_NEAR = 2
"""Links so many joints apart are not checked against each other."""
_ATTEMPTS = 20_000

_Region: TypeAlias = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Center and size [m] of the places of the flange."""
_Pair: TypeAlias = tuple[NDArray[np.float64], NDArray[np.float64]]
_DOWN = quaternion_from_rpy(np.pi, 0.0, 0.0)
_FORWARD = quaternion_from_rpy(0.0, np.pi / 2, 0.0)
_REGIONS: Mapping[str, tuple[tuple[_Region, Quaternion], tuple[_Region, Quaternion]]] = {
    "table": (
        (((0.45, 0.35, 0.4), (0.3, 0.2, 0.2)), _DOWN),
        (((0.45, -0.35, 0.4), (0.3, 0.2, 0.2)), _DOWN),
    ),
    "shelf": (
        (((0.5, 0.0, 0.42), (0.1, 0.4, 0.06)), _FORWARD),
        (((0.5, 0.0, 0.77), (0.1, 0.4, 0.06)), _FORWARD),
    ),
    "bins": (
        (((0.45, 0.3, 0.32), (0.12, 0.12, 0.06)), _DOWN),
        (((0.45, -0.3, 0.32), (0.12, 0.12, 0.06)), _DOWN),
    ),
    "window": (
        (((0.25, 0.0, 0.6), (0.1, 0.3, 0.3)), _FORWARD),
        (((0.62, 0.0, 0.6), (0.1, 0.1, 0.1)), _FORWARD),
    ),
}
SCENES = tuple(_REGIONS)


def arm_scene(name: str) -> PlanningScene:
    """Return a scene by name."""
    scene = PlanningScene(_arm())
    for number, (geometry, position) in enumerate(_things(name)):
        scene.add(CollisionObject(name=f"thing {number}", shapes=(PlacedShape(geometry),), pose=Pose(position)))
    return scene


def queries(scene: PlanningScene, name: str, count: int) -> list[_Pair]:
    """Return starts and goals: valid states with the flange in two regions of a scene."""
    states = [
        _states(scene, region, orientation, count, seed) for seed, (region, orientation) in enumerate(_REGIONS[name])
    ]
    return list(zip(*states, strict=True))


def _arm() -> RobotModel:
    disabled = "".join(
        f'<disable_collisions link1="{_LINKS[i]}" link2="{_LINKS[j]}" reason="Adjacent"/>'
        for i in range(len(_LINKS))
        for j in range(i + 1, min(i + 1 + _NEAR, len(_LINKS)))
    )
    srdf = (_ARMS / "seven_axis.srdf").read_text().replace("</robot>", f"{disabled}</robot>")
    return robot_model((_ARMS / "seven_axis.urdf").read_text(), srdf, None, Diagnostics())


def _states(
    scene: PlanningScene, region: _Region, orientation: Quaternion, count: int, seed: int
) -> list[NDArray[np.float64]]:
    center, size = region
    goal = Constraints(
        positions=(PositionConstraint(link="flange", region=(PlacedShape(Box(size), Pose(center)),)),),
        orientations=(OrientationConstraint(link="flange", orientation=orientation, tolerances=(0.4, 0.4, 4.0)),),
    )
    start = scene.model.state_of(scene.model.group(GROUP).default_states["ready"])
    problem = GroupProblem(scene, GROUP, start)
    found = _planning.goal_states(scene.world, problem.task, start, [problem.goal(goal)], count, _ATTEMPTS, seed)
    if len(found) < count:
        raise RuntimeError(f"only {len(found)} of {count} states have the flange in the region at {center}")
    return list(found)


def _things(name: str) -> list[tuple[Box | Cylinder, tuple[float, float, float]]]:
    table: list[tuple[Box | Cylinder, tuple[float, float, float]]] = [(Box((0.8, 1.4, 0.04)), (0.6, 0.0, 0.2))]
    match name:
        case "table":
            cans = [(0.3, 0.0), (0.45, 0.1), (0.45, -0.1), (0.6, 0.0), (0.7, 0.2), (0.7, -0.2)]
            return table + [(Cylinder(0.04, 0.4), (x, y, 0.42)) for x, y in cans]
        case "shelf":
            boards = [(Box((0.3, 0.8, 0.02)), (0.6, 0.0, z)) for z in (0.25, 0.6, 0.95)]
            sides = [(Box((0.3, 0.02, 0.72)), (0.6, y, 0.6)) for y in (-0.4, 0.4)]
            return [*boards, *sides, (Box((0.02, 0.8, 0.72)), (0.75, 0.0, 0.6))]
        case "bins":
            walls: list[tuple[Box | Cylinder, tuple[float, float, float]]] = []
            for y in (0.3, -0.3):
                walls += [(Box((0.4, 0.02, 0.2)), (0.45, y + side, 0.32)) for side in (-0.2, 0.2)]
                walls += [(Box((0.02, 0.4, 0.2)), (0.45 + side, y, 0.32)) for side in (-0.2, 0.2)]
            return table + walls
        case _:
            sides = [(Box((0.02, 1.0, 1.6)), (0.45, y, 0.8)) for y in (0.66, -0.66)]
            ends = [(Box((0.02, 0.32, 0.44)), (0.45, 0.0, 0.22)), (Box((0.02, 0.32, 0.84)), (0.45, 0.0, 1.18))]
            return [*sides, *ends]

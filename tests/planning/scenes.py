"""Planning scenes of the seven-axis arm."""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from tests.planning.arms import changed_arm

from trundle.planning.planning_scene import CollisionObject, PlacedShape, PlanningScene, ShapeGeometry
from trundle.planning.robot_model import RobotModel
from trundle.spatial import Pose

_LINKS = ("base_link", *(f"link_{i}" for i in range(1, 8)))


@cache
def seven_axis() -> RobotModel:
    """Return the arm; links that are next to each other, or next but one, are not checked."""
    disabled = "".join(
        f'<disable_collisions link1="{_LINKS[i]}" link2="{_LINKS[j]}" reason="Adjacent"/>'
        for i in range(len(_LINKS))
        for j in range(i + 1, min(i + 3, len(_LINKS)))
    )
    return changed_arm("seven_axis", srdf=disabled)


def ready() -> NDArray[np.float64]:
    """Return the state `ready`: the arm bent forwards."""
    model = seven_axis()
    return model.state_of(model.group("arm").default_states["ready"])


def thing(name: str, geometry: ShapeGeometry, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> CollisionObject:
    """Return an object of one shape at a place [m]."""
    return CollisionObject(name=name, shapes=(PlacedShape(geometry),), pose=Pose((x, y, z)))


def scene_with(*objects: CollisionObject) -> PlanningScene:
    """Return a scene of the arm with objects, at `ready`."""
    scene = PlanningScene(seven_axis())
    scene.positions = ready()
    for object in objects:
        scene.add(object)
    return scene

"""Scene of a simulation's page: bodies, frames, cameras, and a slider for each movable joint."""

import math
from dataclasses import dataclass
from itertools import islice

import numpy as np
from msgspec.structs import replace

from trundle.bridge import WORLD_FRAME, link_frames
from trundle.model import Joint, JointType
from trundle.render import scene_from_world
from trundle.sensors import CameraSensor
from trundle.simulation import Simulation
from trundle.viewer import MAX_LINE_POINTS, CameraView, DrawnLine, FrameInfo, JointSlider, ViewerScene, ViewerState

_MAX_LINES = 200
_WIDEST = 2.8
"""Field of view of the pyramid that is drawn for a fisheye camera [rad]."""
_SLIDER_RANGE = math.pi
"""Slider range of a joint without limits [rad or m]."""
_MOVABLE = frozenset({JointType.REVOLUTE, JointType.PRISMATIC})


@dataclass(frozen=True, slots=True, kw_only=True)
class PageScene:
    """A scene, the state it opens with, and the joints of its sliders as (model, joint)."""

    scene: ViewerScene
    first: ViewerState
    joints: list[tuple[str, str]]


def build_page_scene(simulation: Simulation, cameras: list[CameraSensor], *, drive: bool) -> PageScene:
    """Build the scene of a page; `drive`: True if it has a drive pad."""
    world = simulation.world
    movable = [(model.name, joint) for model in world.models if not model.static for joint in model.joints]
    movable = [(name, joint) for name, joint in movable if _is_movable(joint)]
    names = slider_names([(model, joint.name) for model, joint in movable])
    scene = ViewerScene(
        title=f"{world.name} · Trundle",
        # The page draws skins in their first pose: bone poses are not sent to it.
        scene=replace(scene_from_world(world, simulation.report), skins=()),
        collisions=scene_from_world(world, simulation.report, collisions=True),
        frames=tuple(FrameInfo(f.frame, f.parent) for f in link_frames(world)),
        cameras=tuple(
            CameraView(
                camera.name,
                camera.link_index,
                camera.link_from_camera,
                min(camera.intrinsics.horizontal_fov_rad, _WIDEST),
                camera.intrinsics.width_px,
                camera.intrinsics.height_px,
            )
            for camera in cameras
        ),
        joints=tuple(_slider(joint, name) for (_, joint), name in zip(movable, names, strict=True)),
        playback=True,
        drive=drive,
        root_frame=WORLD_FRAME,
        follow_body=_link_of_robot(simulation),
    )
    snapshot = simulation.snapshot()
    first = ViewerState(time_ns=snapshot.time_ns, body_poses=snapshot.poses)
    joints = [(model, joint.name) for model, joint in movable]
    return PageScene(scene=scene, first=first, joints=joints)


def _is_movable(joint: Joint) -> bool:
    return joint.type in _MOVABLE and joint.axis is not None and not joint.axis.is_rigid


def slider_names(joints: list[tuple[str, str]]) -> list[str]:
    """Names of joints, with the model's as prefix if there are several models."""
    several = len({model for model, _ in joints}) > 1
    return [f"{model}/{joint}" if several else joint for model, joint in joints]


def _slider(joint: Joint, name: str) -> JointSlider:
    assert joint.axis is not None
    lower, upper = joint.axis.lower, joint.axis.upper
    return JointSlider(
        name,
        lower if math.isfinite(lower) else -_SLIDER_RANGE,
        upper if math.isfinite(upper) else _SLIDER_RANGE,
    )


def joint_indices(simulation: Simulation, joints: list[tuple[str, str]]) -> list[int]:
    """Index of each joint in `Snapshot.joint_positions`."""
    order = {
        (model.name, joint.name): i
        for i, (model, joint) in enumerate((m, j) for m in simulation.world.models for j in m.joints)
    }
    return [order[key] for key in joints]


def _link_of_robot(simulation: Simulation) -> int | None:
    """Index of the first link of the non-static model with most joints; the first of equals."""
    joints: dict[int, int] = {}
    first = 0
    for model in simulation.world.models:
        if not model.static and model.links:
            joints[first] = len(model.joints)
        first += len(model.links)
    return max(joints, key=joints.__getitem__, default=None)


def drawn_lines(simulation: Simulation) -> tuple[DrawnLine, ...]:
    """Lines that plugins have drawn; of too many points, the first."""
    drawn: list[DrawnLine] = []
    left = MAX_LINE_POINTS
    for line in islice(simulation.lines.values(), _MAX_LINES):
        points = np.array(line.points[-left:], dtype=np.float32).reshape(-1, 3)
        red, green, blue = (round(255 * value) for value in line.rgb)
        drawn.append(DrawnLine(points, (red, green, blue)))
        left -= len(points)
        if left <= 0:
            break
    return tuple(drawn)

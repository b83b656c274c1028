"""The browser page of a simulation: what it shows, and what a press on it does."""

import math
import time
from types import TracebackType
from typing import Self

from trundle.bridge import WORLD_FRAME, link_frames
from trundle.model import Joint, JointType
from trundle.render import scene_of
from trundle.sensors import CameraSensor
from trundle.simulation import Simulation
from trundle.viewer import (
    CameraView,
    Drive,
    FrameInfo,
    JointSlider,
    Pause,
    Play,
    Reset,
    SetJoint,
    SetSpeed,
    Step,
    Viewer,
    ViewerScene,
    ViewerState,
)

from .pace import Pacer
from .ros_side import RosSide

_FRAME_NS = 33_000_000
"""The page is fed 30 times a second of wall time."""
_DRIVE_NS = 100_000_000
"""10 Hz, as the tutorials' `rostopic pub -r 10`."""
_SLIDER_RANGE = math.pi
"""Of a joint without limits [rad or m]."""
_SLIDER_TORQUE = 10.0
"""What a joint moved by hand may use [N·m or N]."""
_MOVABLE = frozenset({JointType.REVOLUTE, JointType.PRISMATIC})


class Page:
    """Feeds a viewer from one simulation, and does what its buttons ask."""

    def __init__(
        self, viewer: Viewer, simulation: Simulation, ros: RosSide | None, joints: list[tuple[str, str]]
    ) -> None:
        self._viewer = viewer
        self._simulation = simulation
        self._ros = ros
        self._joints = dict(zip(_slider_names(joints), joints, strict=True))
        self._slider_indices = _joint_indices(simulation, joints)
        self._fed_ns = 0
        self._command = (0.0, 0.0)
        self._drive_due_ns: int | None = None

    @classmethod
    def open(
        cls,
        simulation: Simulation,
        cameras: list[CameraSensor],
        ros: RosSide | None,
        *,
        host: str,
        port: int | None,
    ) -> Self:
        """Start the page.

        Raises:
            UsageError: the port asked for is taken.
        """
        world = simulation.world
        movable = [(model.name, joint) for model in world.models if not model.static for joint in model.joints]
        movable = [(name, joint) for name, joint in movable if _is_movable(joint)]
        names = _slider_names([(model, joint.name) for model, joint in movable])
        scene = ViewerScene(
            title=f"{world.name} · Trundle",
            scene=scene_of(world, simulation.report),
            collisions=scene_of(world, simulation.report, collisions=True),
            frames=tuple(FrameInfo(f.frame, f.parent) for f in link_frames(world)),
            cameras=tuple(
                CameraView(
                    camera.name,
                    camera.link_index,
                    camera.link_from_camera,
                    camera.intrinsics.horizontal_fov_rad,
                    camera.intrinsics.width_px,
                    camera.intrinsics.height_px,
                )
                for camera in cameras
            ),
            joints=tuple(_slider(joint, name) for (_, joint), name in zip(movable, names, strict=True)),
            playback=True,
            drive=ros is not None,
            root_frame=WORLD_FRAME,
            follow_body=_first_moving_link(simulation),
        )
        snapshot = simulation.snapshot()
        first = ViewerState(time_ns=snapshot.time_ns, body_poses=snapshot.poses)
        viewer = Viewer.start(scene, host=host, port=port, state=first)
        page = cls(viewer, simulation, ros, [(model, joint.name) for model, joint in movable])
        for index, camera in enumerate(cameras):
            camera.listen(lambda reading, index=index: viewer.image(index, reading.rgb), wanted=lambda: viewer.alive)
        return page

    @property
    def url(self) -> str:
        """Where the page is."""
        return self._viewer.url

    def feed(self, pacer: Pacer, *, paused: bool, at_once: bool = False) -> None:
        """Show where everything is now, if the page has not been fed just before."""
        now = time.monotonic_ns()
        if not at_once and now - self._fed_ns < _FRAME_NS:
            return
        self._fed_ns = now
        snapshot = self._simulation.snapshot()
        self._viewer.show(
            ViewerState(
                time_ns=snapshot.time_ns,
                body_poses=snapshot.poses,
                joint_positions=snapshot.joint_positions[self._slider_indices],
                real_time_factor=None if paused else pacer.real_time_factor,
                paused=paused,
            )
        )

    def obey(self, pacer: Pacer, *, paused: bool) -> bool:
        """Do what was pressed since the last call; return whether the simulation is paused now."""
        for request in self._viewer.requests():
            match request:
                case Play():
                    paused = False
                    pacer.restart()
                case Pause():
                    paused = True
                case Step(count):
                    paused = True
                    self._simulation.step(count)
                    pacer.restart()
                    self.feed(pacer, paused=True, at_once=True)
                case Reset():
                    self._simulation.reset()
                    pacer.restart()
                    self.feed(pacer, paused=paused, at_once=True)
                case SetSpeed(factor):
                    pacer.set_speed(None if math.isinf(factor) else factor)
                case SetJoint(name, position):
                    model, joint = self._joints[name]
                    self._simulation[model].joint(joint).hold(position, max_effort=_SLIDER_TORQUE)
                case Drive(linear, angular):
                    self._command = (linear, angular)
                    self._drive_due_ns = 0
                case _:
                    pass
        self._keep_driving()
        return paused

    def _keep_driving(self) -> None:
        """Repeat a velocity that is not zero: many controllers stop a robot that hears no more."""
        now = time.monotonic_ns()
        if self._ros is None or self._drive_due_ns is None or now < self._drive_due_ns:
            return
        self._ros.drive(*self._command)
        self._drive_due_ns = now + _DRIVE_NS if any(self._command) else None

    def close(self) -> None:
        """Take the page down."""
        self._viewer.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _is_movable(joint: Joint) -> bool:
    return joint.type in _MOVABLE and joint.axis is not None and not joint.axis.is_rigid


def _slider_names(joints: list[tuple[str, str]]) -> list[str]:
    """The joints' own names; with their model's in front where there are several models."""
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


def _joint_indices(simulation: Simulation, joints: list[tuple[str, str]]) -> list[int]:
    order = {
        (model.name, joint.name): i
        for i, (model, joint) in enumerate((m, j) for m in simulation.world.models for j in m.joints)
    }
    return [order[key] for key in joints]


def _first_moving_link(simulation: Simulation) -> int | None:
    links = [(model, link) for model in simulation.world.models for link in model.links]
    return next((i for i, (model, _) in enumerate(links) if not model.static), None)

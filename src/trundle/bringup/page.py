"""Browser page of a simulation: feeds it the state and handles its requests."""

import math
import time
from collections.abc import Sequence
from functools import partial
from typing import Protocol, Self

from trundle.page_address import PageAddress
from trundle.sensors import CameraReading, CameraSensor, InstrumentSensor
from trundle.simulation import Simulation
from trundle.viewer import Drive, Pause, Play, Reset, SetJoint, SetSpeed, Step, Viewer, ViewerState

from .page_scene import build_page_scene, drawn_lines, joint_indices, slider_names
from .ray_overlay import RayOverlay
from .realtime_pacer import RealtimePacer

_FRAME_NS = 33_000_000
"""Period of updates, in wall time [ns]."""
_DRIVE_NS = 100_000_000
"""Period of cmd_vel [ns]: 10 Hz, as the tutorials' `rostopic pub -r 10`."""
_SLIDER_TORQUE = 10.0
"""Effort limit of a joint that a slider moves [N·m or N]."""


class Driver(Protocol):
    """Publisher of the drive pad's commands."""

    def drive(self, linear: float, angular: float) -> None:
        """Publish a velocity command [m/s, rad/s]."""
        ...


class SimulationPage:
    """Viewer of one simulation; handles its buttons, sliders and drive pad."""

    def __init__(
        self, viewer: Viewer, simulation: Simulation, driver: Driver | None, joints: list[tuple[str, str]]
    ) -> None:
        self._viewer = viewer
        self._driver = driver
        self._ray_overlay = RayOverlay(lambda: viewer.alive)
        self._numbers: dict[CameraSensor, int] = {}
        """Camera → its number on the page."""
        self._listened: set[CameraSensor] = set()
        self._follow(simulation, joints)
        self._updated_ns = 0
        self._command = (0.0, 0.0)
        self._drive_due_ns: int | None = None

    @classmethod
    def open(
        cls,
        simulation: Simulation,
        sensors: Sequence[CameraSensor | InstrumentSensor],
        driver: Driver | None,
        at: PageAddress,
    ) -> Self:
        """Start the page.

        Raises:
            UsageError: the port is taken.
        """
        layout = build_page_scene(simulation, _cameras(sensors), drive=driver is not None)
        viewer = Viewer.start(layout.scene, host=at.host, port=at.port, allowed=at.allowed, state=layout.first)
        page = cls(viewer, simulation, driver, layout.joints)
        page._listen(sensors)
        return page

    def reload(self, simulation: Simulation, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        """Rebuild the scene after models came or went."""
        layout = build_page_scene(simulation, _cameras(sensors), drive=self._driver is not None)
        self._viewer.replace(layout.scene, state=layout.first)
        self._follow(simulation, layout.joints)
        self._listen(sensors)

    def _follow(self, simulation: Simulation, joints: list[tuple[str, str]]) -> None:
        self._simulation = simulation
        simulation.lines_are_shown = True
        self._joints = dict(zip(slider_names(joints), joints, strict=True))
        self._slider_indices = joint_indices(simulation, joints)

    def _listen(self, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        self._ray_overlay.set_sensors(sensors)
        cameras = _cameras(sensors)
        new = [camera for camera in cameras if camera not in self._listened]
        self._numbers = {camera: number for number, camera in enumerate(cameras)}
        self._listened.update(new)
        for camera in new:
            camera.listen(partial(self._show_picture, camera), enabled=partial(self._wants_picture, camera))

    def _wants_picture(self, camera: CameraSensor) -> bool:
        return camera in self._numbers and self._viewer.alive

    def _show_picture(self, camera: CameraSensor, reading: CameraReading) -> None:
        self._viewer.image(self._numbers[camera], reading.rgb)

    @property
    def url(self) -> str:
        """URL of the page."""
        return self._viewer.url

    def update(self, pacer: RealtimePacer, *, paused: bool, at_once: bool = False) -> None:
        """Send the page the current state, at most 30 times per second unless `at_once`."""
        now = time.monotonic_ns()
        if not at_once and now - self._updated_ns < _FRAME_NS:
            return
        self._updated_ns = now
        snapshot = self._simulation.snapshot()
        self._viewer.show(
            ViewerState(
                time_ns=snapshot.time_ns,
                body_poses=snapshot.poses,
                joint_positions=snapshot.joint_positions[self._slider_indices],
                real_time_factor=None if paused else pacer.real_time_factor,
                paused=paused,
                lines=(*drawn_lines(self._simulation), *self._ray_overlay.lines(snapshot)),
            )
        )

    def handle_requests(self, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Handle the requests since the last call; return True if the simulation is paused now."""
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
                    self.update(pacer, paused=True, at_once=True)
                case Reset():
                    self._simulation.reset()
                    pacer.restart()
                    self.update(pacer, paused=paused, at_once=True)
                case SetSpeed(factor):
                    pacer.set_speed(None if math.isinf(factor) else factor)
                case SetJoint(name, position):
                    model, joint = self._joints[name]
                    self._simulation[model].joint(joint).command_position(position, max_effort=_SLIDER_TORQUE)
                case Drive(linear, angular):
                    self._command = (linear, angular)
                    self._drive_due_ns = 0
                case _:
                    pass
        self._repeat_command()
        return paused

    def _repeat_command(self) -> None:
        """Repeat a velocity that is not zero: many controllers stop the robot when commands cease."""
        now = time.monotonic_ns()
        if self._driver is None or self._drive_due_ns is None or now < self._drive_due_ns:
            return
        self._driver.drive(*self._command)
        self._drive_due_ns = now + _DRIVE_NS if any(self._command) else None

    def close(self) -> None:
        """Close the page."""
        self._viewer.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _cameras(sensors: Sequence[CameraSensor | InstrumentSensor]) -> list[CameraSensor]:
    return [sensor for sensor in sensors if isinstance(sensor, CameraSensor)]

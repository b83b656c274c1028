"""Sensors of a running world, by name, as models are spawned and deleted."""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError
from trundle.sim.render import Renderer, Scene
from trundle.sim.simulation import ModelHandle, Simulation

from .cameras.camera import CameraSensor
from .cameras.camera_handle import CameraHandle
from .cameras.mount import mount_cameras
from .instruments import mount_sensors
from .sensor_handle import SensorHandle

if TYPE_CHECKING:
    from .mount_instruments import InstrumentSensor
    from .range import RangeSensor
    from .ray_scene import RayScene


class MountedSensors:
    """Sensors of one simulation; those of spawned models are mounted on the next lookup."""

    def __init__(self, simulation: Simulation, make: Callable[[Scene], Renderer]) -> None:
        """Mount the existing sensors.

        Args:
            simulation: with its sensors.
            make: creates the renderer that cameras share.
        """
        self._simulation = simulation
        self._make = make
        self._mounted: list[tuple[ModelHandle, CameraSensor | InstrumentSensor]] = []
        self._known: list[ModelHandle] = []
        self._started: list[CameraSensor | InstrumentSensor] = []
        self._handles: list[tuple[CameraSensor | InstrumentSensor, SensorHandle]] = []
        self._update()

    def start(self) -> None:
        """Start all sensors; each measures at its rate while it has a listener."""
        for _, sensor in self._mounted:
            self._start(sensor)

    @property
    def cameras(self) -> "list[CameraSensor]":
        """Cameras in file order."""
        return [sensor for _, sensor in self._mounted if isinstance(sensor, CameraSensor)]

    @property
    def instruments(self) -> "list[InstrumentSensor]":
        """Sensors other than cameras, in file order."""
        return [sensor for _, sensor in self._mounted if not isinstance(sensor, CameraSensor)]

    def camera(self, name: str) -> CameraHandle:
        """Return a camera by name; see `Simulation.camera`."""
        full, sensor = _find(name, self._named(CameraSensor), "camera")
        assert isinstance(sensor, CameraSensor)
        return CameraHandle(self._simulation, sensor, full)

    def sensor(self, name: str) -> SensorHandle:
        """Return a sensor by name; see `Simulation.sensor`."""
        full, sensor = _find(name, self._named(object), "sensor")
        for each, handle in self._handles:
            if each is sensor:
                return handle
        if sensor.has_history:
            self._start(sensor)
        handle = SensorHandle(self._simulation, sensor, full)
        self._handles.append((sensor, handle))
        return handle

    def range_sensor(self, name: str) -> "RangeSensor":
        """Return a lidar or ray sensor by name; see `LoadedSimulation.range_sensor`."""
        from .range import RangeSensor

        _, sensor = _find(name, self._named(RangeSensor), "lidar")
        assert isinstance(sensor, RangeSensor)
        return sensor

    def names(self) -> tuple[str, ...]:
        """Return `model::link::sensor` of each sensor, in file order."""
        return tuple(self._named(object))

    def camera_names(self) -> tuple[str, ...]:
        """Return the names of the cameras."""
        return tuple(self._named(CameraSensor))

    def _start(self, sensor: "CameraSensor | InstrumentSensor") -> None:
        if not any(each is sensor for each in self._started):
            self._started.append(sensor)
            sensor.start(self._simulation)

    def _update(self) -> None:
        """Mount the sensors of spawned models, and drop those of deleted ones."""
        models = self._simulation.models
        for model in models:
            if not any(model is known for known in self._known):
                self._mount(model)
        self._known = list(models)
        self._mounted = [each for each in self._mounted if any(each[0] is model for model in models)]

    def _mount(self, model: ModelHandle) -> None:
        cameras = mount_cameras(self._simulation, self._make, model=model.name, beside=self.cameras)
        self._mounted += [(model, camera) for camera in cameras]
        if model.model.links:
            instruments = mount_sensors(self._simulation, model=model.name, ray_scene=self._ray_scene)
            self._mounted += [(model, instrument) for instrument in instruments]

    @cached_property
    def _ray_scene(self) -> "RayScene":
        from .ray_scene import RayScene

        return RayScene(self._simulation)

    def _named(self, kind: type) -> "dict[str, CameraSensor | InstrumentSensor]":
        self._update()
        return {
            f"{model.name}::{sensor.parent_name}::{sensor.name}": sensor
            for model, sensor in self._mounted
            if isinstance(sensor, kind)
        }


def _find(
    name: str, named: "Mapping[str, CameraSensor | InstrumentSensor]", kind: str
) -> "tuple[str, CameraSensor | InstrumentSensor]":
    """Return the sensor whose scoped name is `name` or ends in it, as Gazebo's SensorManager::GetSensor does.

    Raises:
        UsageError: there is none, or there are several; with the names there are.
    """
    found = [full for full in named if full == name] or [full for full in named if full.endswith(f"::{name}")]
    if len(found) == 1:
        return found[0], named[found[0]]
    names = ", ".join(map(repr, found or named)) or "none"
    if found:
        raise UsageError(f"several {kind}s are called {name!r}; write one of {names}")
    raise UsageError(f"no {kind} {name!r}; there are: {names}")

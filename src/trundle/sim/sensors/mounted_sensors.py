"""Sensors of a running world, by name, as models are spawned and deleted."""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from trundle.base.diagnostics import UsageError, no_such
from trundle.sim.simulation import ModelHandle, Simulation

from .cameras.mount import mount_cameras
from .instruments import has_instruments, mount_sensors

if TYPE_CHECKING:  # worlds without cameras or lidars do not import their modules
    from trundle.sim.render import Renderer, Scene

    from .cameras.camera import CameraSensor
    from .cameras.camera_handle import CameraHandle
    from .mount_instruments import InstrumentSensor
    from .range import RangeSensor
    from .ray_scene import RayScene
    from .sensor_handle import SensorHandle

    AnySensor: TypeAlias = CameraSensor | InstrumentSensor

_Sensor = TypeVar("_Sensor", bound="AnySensor")


class MountedSensors:
    """Sensors of one simulation; `update`, and each lookup, follows spawned and deleted models."""

    def __init__(self, simulation: Simulation, make: "Callable[[Scene], Renderer]") -> None:
        """Mount the existing sensors.

        Args:
            simulation: simulation with the sensors.
            make: creates the renderer shared by cameras.
        """
        self._simulation = simulation
        self._make = make
        self._cameras: list[tuple[ModelHandle, CameraSensor]] = []
        self._instruments: list[tuple[ModelHandle, InstrumentSensor]] = []
        self._models: list[ModelHandle] = []
        self._started: dict[int, AnySensor] = {}
        """Started sensors, by identity."""
        self._handles: list[tuple[AnySensor, SensorHandle]] = []
        self.update()

    def start(self) -> None:
        """Start all sensors; each measures at its rate while it has a listener."""
        for sensor in (*self.cameras, *self.instruments):
            self._start(sensor)

    @property
    def cameras(self) -> "list[CameraSensor]":
        """Cameras in file order."""
        return [camera for _, camera in self._cameras]

    @property
    def instruments(self) -> "list[InstrumentSensor]":
        """Sensors other than cameras, in file order."""
        return [instrument for _, instrument in self._instruments]

    def of_model(self, model: ModelHandle) -> "tuple[list[CameraSensor], list[InstrumentSensor]]":
        """Return the cameras and the other sensors of a model."""
        cameras = [camera for owner, camera in self._cameras if owner is model]
        return cameras, [instrument for owner, instrument in self._instruments if owner is model]

    def camera(self, name: str) -> "CameraHandle":
        """Return a camera by name; see `LoadedSimulation.camera`."""
        from .cameras.camera_handle import CameraHandle

        self.update()
        full, camera = _find(name, _by_name(self._cameras), "camera")
        return CameraHandle(self._simulation, camera, full)

    def sensor(self, name: str) -> "SensorHandle":
        """Return a sensor by name; see `LoadedSimulation.sensor`."""
        from .sensor_handle import SensorHandle

        full, sensor = _find(name, self._all(), "sensor")
        for handled, handle in self._handles:
            if handled is sensor:
                return handle
        if sensor.has_history:
            self._start(sensor)
        handle = SensorHandle(self._simulation, sensor, full)
        self._handles.append((sensor, handle))
        return handle

    def range_sensor(self, name: str) -> "RangeSensor":
        """Return a lidar or ray sensor by name; see `LoadedSimulation.range_sensor`."""
        from .range import RangeSensor

        self.update()
        lidars = [(model, sensor) for model, sensor in self._instruments if isinstance(sensor, RangeSensor)]
        return _find(name, _by_name(lidars), "lidar")[1]

    def names(self) -> tuple[str, ...]:
        """Return `model::link::sensor` of each sensor, in file order."""
        return tuple(self._all())

    def camera_names(self) -> tuple[str, ...]:
        """Return the names of the cameras."""
        self.update()
        return tuple(_by_name(self._cameras))

    def update(self) -> None:
        """Mount the sensors of spawned models; stop and drop those of deleted ones."""
        mounted = set(map(id, self._models))
        spawned = [model for model in self._simulation.models if id(model) not in mounted]
        if len(spawned) > 1 and not mounted:
            self._mount({model.name: model for model in spawned}, None)
        else:
            for model in spawned:
                self._mount({model.name: model}, model.name)
        self._models = list(self._simulation.models)
        self._cameras = self._remaining(self._cameras)
        self._instruments = self._remaining(self._instruments)

    def _remaining(self, mounted: "list[tuple[ModelHandle, _Sensor]]") -> "list[tuple[ModelHandle, _Sensor]]":
        """Stop the sensors of deleted models; return the others."""
        existing = set(map(id, self._models))
        for model, sensor in mounted:
            if id(model) not in existing and (started := self._started.pop(id(sensor), None)) is not None:
                started.stop(self._simulation)
        return [(model, sensor) for model, sensor in mounted if id(model) in existing]

    def _start(self, sensor: "AnySensor") -> None:
        if id(sensor) not in self._started:
            self._started[id(sensor)] = sensor
            sensor.start(self._simulation)

    def _mount(self, models: Mapping[str, ModelHandle], name: str | None) -> None:
        """Mount the sensors of the model of a name; None: of all models."""
        cameras = mount_cameras(self._simulation, self._make, model=name, existing=self.cameras)
        self._cameras += [(models[camera.model.name], camera) for camera in cameras]
        if any(has_instruments(model.model) for model in models.values()):
            instruments = mount_sensors(self._simulation, model=name, ray_scene=self._ray_scene)
            self._instruments += [(models[instrument.model.name], instrument) for instrument in instruments]

    @cached_property
    def _ray_scene(self) -> "RayScene":
        from .ray_scene import RayScene

        return RayScene(self._simulation)

    def _all(self) -> "dict[str, AnySensor]":
        """Return all sensors by name, model by model."""
        self.update()
        return {
            name: sensor
            for model in self._models
            for mounted in (self._cameras, self._instruments)
            for name, sensor in _by_name([(owner, sensor) for owner, sensor in mounted if owner is model]).items()
        }


def _by_name(mounted: "list[tuple[ModelHandle, _Sensor]]") -> "dict[str, _Sensor]":
    return {f"{model.name}::{sensor.parent_name}::{sensor.name}": sensor for model, sensor in mounted}


def _find(name: str, named: "Mapping[str, _Sensor]", kind: str) -> "tuple[str, _Sensor]":
    """Return the sensor whose scoped name is `name` or ends in it, as Gazebo's SensorManager::GetSensor does.

    Raises:
        UsageError: no or several sensors match; the message lists the names.
    """
    matches = [full for full in named if full == name] or [full for full in named if full.endswith(f"::{name}")]
    if len(matches) == 1:
        return matches[0], named[matches[0]]
    if matches:
        raise UsageError(f"several {kind}s are called {name!r}; write one of {', '.join(map(repr, matches))}")
    raise UsageError(no_such(f"no {kind}", name, list(named)))

"""A sensor of a running simulation, by name."""

from typing import TYPE_CHECKING, TypeAlias

from trundle.simulation import Simulation

if TYPE_CHECKING:  # a world loads the modules of the sensors that it has
    from .air import PressureReading
    from .altimeter import AltimeterReading
    from .cameras.camera import CameraReading, CameraSensor
    from .contact import ContactReading
    from .force_torque import ForceTorqueReading
    from .gps import GpsReading
    from .imu import ImuReading
    from .logical_camera import LogicalCameraReading
    from .magnetometer import MagnetometerReading
    from .mount_instruments import InstrumentSensor
    from .range import RangeReading
    from .sonar import SonarReading
    from .wireless import RfidReading, WirelessReading

    SensorReading: TypeAlias = (
        AltimeterReading
        | CameraReading
        | ContactReading
        | ForceTorqueReading
        | GpsReading
        | ImuReading
        | LogicalCameraReading
        | MagnetometerReading
        | PressureReading
        | RangeReading
        | RfidReading
        | SonarReading
        | WirelessReading
    )


class SensorHandle:
    """One sensor of any type; it belongs to the thread that owns the simulation."""

    def __init__(self, simulation: Simulation, sensor: "CameraSensor | InstrumentSensor", name: str) -> None:
        self._simulation = simulation
        self._sensor = sensor
        self._latest: SensorReading | None = None
        self.name = name
        """`model::link::sensor`; of a joint's: `model::joint::sensor`."""
        if sensor.has_history:
            sensor.listen(self._keep)
            simulation.on_reset(self._forget)

    @property
    def type(self) -> str:
        """SDF's word: camera, ray, imu, …"""
        return self._sensor.sensor.type

    @property
    def rate_hz(self) -> float:
        """How often it measures by itself; 0: at every step."""
        return self._sensor.rate_hz

    def read(self) -> "SensorReading":
        """Measure now, with the sensor's noise.

        IMUs and contact sensors need what was before. From when they are first asked for by name they measure at their
        own rate, and this is the latest they measured; before that, an IMU knows no acceleration but gravity.
        """
        latest = self._latest
        if latest is not None and latest.time_ns <= self._simulation.time_ns:
            return latest
        return self._sensor.measure(self._simulation.snapshot())

    def _keep(self, reading: "SensorReading") -> None:
        self._latest = reading

    def _forget(self) -> None:
        self._latest = None

    def __repr__(self) -> str:
        return f"<SensorHandle {self.name!r}: {self.type}>"

"""Handle of a sensor of a running simulation."""

from typing import TYPE_CHECKING, TypeAlias

from trundle.sim.simulation import Simulation

if TYPE_CHECKING:  # a world imports only the modules of its sensors
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
    """Handle of a sensor of any type; it belongs to the thread that owns the simulation."""

    __module__ = "trundle"

    def __init__(self, simulation: Simulation, sensor: "CameraSensor | InstrumentSensor", name: str) -> None:
        self._simulation = simulation
        self._sensor = sensor
        self._latest: SensorReading | None = None
        self.name = name
        """Name `model::link::sensor`, or `model::joint::sensor` on a joint."""
        if sensor.has_history:
            sensor.listen(self._keep)
            simulation.on_reset(self._forget)

    @property
    def type(self) -> str:
        """SDF type: camera, ray, imu, …"""
        return self._sensor.sensor.type

    @property
    def rate_hz(self) -> float:
        """Update rate [Hz]; 0: every step."""
        return self._sensor.rate_hz

    def read(self) -> "SensorReading":
        """Return a reading of the current state, with the sensor's noise.

        IMUs and contact sensors depend on earlier states. From their first lookup by name on they measure at their
        own rate, and `read` returns their latest reading; until the first, an IMU has no acceleration other than
        gravity.
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

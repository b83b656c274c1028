"""Sensor controllers: they do not load, as in Gazebo, whose default hardware has no sensor interfaces."""

from typing import ClassVar, Never

from trundle.robots.parameters import ParamError

from .controller import ControllerContext


class SensorController:
    """Controller of a sensor interface, which simulated hardware lacks."""

    interface: ClassVar[str]

    @classmethod
    def create(cls, context: ControllerContext) -> Never:
        """Refuse.

        Raises:
            ParamError: always.
        """
        raise ParamError(
            f"{context.name} requires a hardware interface of type 'hardware_interface::{cls.interface}', which "
            "gazebo_ros_control's default hardware lacks; a sensor's own plugin publishes without a controller"
        )


class ImuSensor(SensorController):
    """imu_sensor_controller/ImuSensorController."""

    interface = "ImuSensorInterface"


class ForceTorqueSensor(SensorController):
    """force_torque_sensor_controller/ForceTorqueSensorController."""

    interface = "ForceTorqueSensorInterface"

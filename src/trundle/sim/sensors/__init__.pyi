from .air import (
    AirPressureSensor as AirPressureSensor,
    AirSpeedSensor as AirSpeedSensor,
    PressureReading as PressureReading,
)
from .altimeter import AltimeterReading as AltimeterReading, AltimeterSensor as AltimeterSensor
from .cameras.bounding_box import BoundingBoxCameraSensor as BoundingBoxCameraSensor
from .cameras.camera import CameraReading as CameraReading, CameraSensor as CameraSensor, DetectedBox as DetectedBox
from .cameras.camera_handle import CameraHandle as CameraHandle
from .cameras.camera_image import CameraImage as CameraImage
from .cameras.depth import DepthCameraSensor as DepthCameraSensor
from .cameras.lens import radius_of as radius_of
from .cameras.mount import SIMULATED_CAMERAS as SIMULATED_CAMERAS, mount_cameras as mount_cameras
from .cameras.pixel_formats import pixels_in as pixels_in
from .cameras.projection import CameraProjection as CameraProjection, PinholeProjection as PinholeProjection
from .cameras.scene import CameraScene as CameraScene
from .cameras.segmentation import SegmentationCameraSensor as SegmentationCameraSensor
from .cameras.thermal import ThermalCameraSensor as ThermalCameraSensor
from .contact import ContactReading as ContactReading, ContactRecord as ContactRecord, ContactSensor as ContactSensor
from .force_torque import ForceTorqueReading as ForceTorqueReading, ForceTorqueSensor as ForceTorqueSensor
from .gps import GpsReading as GpsReading, GpsSensor as GpsSensor, geodetic as geodetic
from .imu import ImuReading as ImuReading, ImuSensor as ImuSensor
from .instruments import mount_sensors as mount_sensors
from .live_sensor import SensorMount as SensorMount
from .logical_camera import LogicalCameraReading as LogicalCameraReading, LogicalCameraSensor as LogicalCameraSensor
from .magnetometer import MagnetometerReading as MagnetometerReading, MagnetometerSensor as MagnetometerSensor
from .mount_instruments import InstrumentSensor as InstrumentSensor
from .mounted_sensors import MountedSensors as MountedSensors
from .noise import NoiseSource as NoiseSource
from .range import (
    RangeReading as RangeReading,
    RangeSensor as RangeSensor,
    angles_of as angles_of,
    directions_of as directions_of,
)
from .ray_scene import RayScene as RayScene
from .sensor_handle import SensorHandle as SensorHandle
from .sonar import SonarReading as SonarReading, SonarSensor as SonarSensor
from .wireless import (
    RfidReading as RfidReading,
    RfidSensor as RfidSensor,
    WirelessReading as WirelessReading,
    WirelessSensor as WirelessSensor,
)

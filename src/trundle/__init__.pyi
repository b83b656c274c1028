from . import gym as gym, ros as ros, spatial as spatial
from .base.diagnostics import (
    DescriptionError as DescriptionError,
    Diagnostic as Diagnostic,
    Diagnostics as Diagnostics,
    Source as Source,
    TrundleError as TrundleError,
    TrundleWarning as TrundleWarning,
    UsageError as UsageError,
)
from .gazebo.plugins import Plugin as Plugin, VisualPlugin as VisualPlugin, WorldPlugin as WorldPlugin
from .live.film import Film as Film
from .live.loaded_simulation import LoadedSimulation as LoadedSimulation
from .live.loading import load as load
from .live.plot import Plot as Plot
from .live.recording import Recording as Recording
from .live.view import View as View
from .page.profile.stride_profile import StrideProfile as StrideProfile
from .robots.description import Joint as Joint, Link as Link, Model as Model, World as World
from .robots.meshes import MeshError as MeshError
from .robots.model import (
    AirPressure as AirPressure,
    AirSpeed as AirSpeed,
    Altimeter as Altimeter,
    CameraOptics as CameraOptics,
    Distortion as Distortion,
    ForceTorque as ForceTorque,
    GpsNoise as GpsNoise,
    ImuNoise as ImuNoise,
    JointAxis as JointAxis,
    Lens as Lens,
    LogicalCamera as LogicalCamera,
    Magnetometer as Magnetometer,
    Noise as Noise,
    OrientationReference as OrientationReference,
    PixelIntrinsics as PixelIntrinsics,
    PluginTag as PluginTag,
    Projection as Projection,
    RangeScan as RangeScan,
    ScanAxis as ScanAxis,
    Sonar as Sonar,
    Surface as Surface,
    Transceiver as Transceiver,
)
from .robots.parameters import TagParameters as TagParameters
from .sim.physics import (
    Contact as Contact,
    Contacts as Contacts,
    SimulationUnstableError as SimulationUnstableError,
)
from .sim.sensors import (
    AltimeterReading as AltimeterReading,
    CameraHandle as CameraHandle,
    CameraImage as CameraImage,
    CameraReading as CameraReading,
    ContactReading as ContactReading,
    ForceTorqueReading as ForceTorqueReading,
    GpsReading as GpsReading,
    ImuReading as ImuReading,
    LogicalCameraReading as LogicalCameraReading,
    MagnetometerReading as MagnetometerReading,
    PressureReading as PressureReading,
    RangeReading as RangeReading,
    RfidReading as RfidReading,
    SensorHandle as SensorHandle,
    SonarReading as SonarReading,
    WirelessReading as WirelessReading,
)
from .sim.simulation import (
    JointHandle as JointHandle,
    LinkHandle as LinkHandle,
    ModelHandle as ModelHandle,
    SavedSimulation as SavedSimulation,
    Simulation as Simulation,
    Snapshot as Snapshot,
    StateLog as StateLog,
    read_state_log as read_state_log,
)
from .spatial import Pose as Pose, Twist as Twist, Wrench as Wrench
from .studies.dataset.make_dataset import DatasetResult as DatasetResult, dataset as dataset
from .studies.sweep.run_sweep import SweepResult as SweepResult, sweep as sweep

__version__: str

"""Camera sensors: snapshots in, images out."""

from collections.abc import Callable, Sequence
from typing import ClassVar

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import CameraOptics, Noise
from trundle.sim.render import Intrinsics, Picture, add_color_noise
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose

from ..live_sensor import LiveSensor, SensorMount
from .projection import PinholeProjection, projection_of
from .scene import CameraScene, RenderRequest

DEFAULT_RATE_HZ = 30.0
"""Update rate of a camera whose update_rate is 0; Gazebo then renders at every step."""


class DetectedBox(Struct, frozen=True, kw_only=True):
    """Detection by a bounding box camera."""

    model: str
    label: int
    center: tuple[float, ...]
    """[px]; for a 3D box [m], in the camera frame."""
    size: tuple[float, ...]
    """[px]; for a 3D box [m], along its axes."""
    camera_from_box: Pose = Pose()
    """Pose of a 3D box."""


class CameraReading(Struct, frozen=True, eq=False, kw_only=True):
    """Camera reading; fields that the kind of camera does not measure are None."""

    __module__ = "trundle"

    time_ns: int
    """Simulation time of the snapshot rendered."""
    rgb: NDArray[np.uint8]
    """(height, width, 3) Color image; grey for a thermal camera, one color per label for a segmentation camera."""
    depth: NDArray[np.float32] | None = None
    """(height, width) Depth along the view axis [m]; NaN outside the depth range."""
    labels: NDArray[np.uint8] | NDArray[np.int32] | None = None
    """(height, width) Label, or 65536 · label + instance number."""
    boxes: tuple[DetectedBox, ...] | None = None
    temperatures: NDArray[np.float32] | None = None
    """(height, width) [K]"""


class CameraSensor(LiveSensor[CameraReading]):
    """Camera that renders when it is due and an output is in use.

    Images of one size that are due in the same step are rendered in one batch.
    """

    needs_depth: ClassVar[bool] = False
    needs_segmentation: ClassVar[bool] = False
    """Render passes needed besides color."""
    sees_labels: ClassVar[bool] = False
    """True if the camera identifies objects by their labels."""

    def __init__(self, mount: SensorMount, optics: CameraOptics, *, scene: CameraScene) -> None:
        """Mount a camera.

        Args:
            mount: model, link and sensor.
            optics: optics of this camera.
            scene: scene shared by all cameras.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        self.optics = optics
        self.link_from_camera: Pose = mount.sensor.link_from_sensor @ optics.sensor_from_camera
        self.intrinsics = Intrinsics(
            width_px=optics.width_px,
            height_px=optics.height_px,
            horizontal_fov_rad=optics.horizontal_fov_rad,
            near_m=optics.near_m,
            far_m=optics.far_m,
        )
        self.projection = projection_of(optics, self.intrinsics)
        self._mount = mount
        self.image_count = 0
        """Images rendered."""
        self.scene = scene
        self.multicamera: Sequence[CameraSensor] = (self,)
        """All cameras of its sensor, which share one clock."""
        self._is_triggered: bool | None = None
        """True while a trigger is pending; None: the camera is not triggered."""
        self._request: RenderRequest | None = None

    def set_rate(self, rate_hz: float) -> None:
        """Set the update rate of all cameras of the sensor [Hz]."""
        for camera in self.multicamera:
            LiveSensor.set_rate(camera, rate_hz)

    @property
    def name(self) -> str:
        """Sensor name; for a camera of a multicamera `<sensor>/<camera>`."""
        return f"{self.sensor.name}/{self.optics.name}" if self.optics.name else self.sensor.name

    @property
    def is_pinhole(self) -> bool:
        """True if the image is a plain rendering, without lens or distortion."""
        return isinstance(self.projection, PinholeProjection)

    def await_trigger(self) -> Callable[[], None]:
        """Switch to triggered mode and return the trigger function, which any thread may call; the camera renders at
        the next due time.
        """
        self._is_triggered = False

        def trigger() -> None:
            self._is_triggered = True

        return trigger

    def enabled(self) -> bool:
        """True if a listener is active and no trigger is outstanding."""
        return self._is_triggered is not False and super().enabled()

    def after_step(self, snapshot: Snapshot) -> None:
        """Render an image and pass it to the listeners."""
        self._is_triggered = self._is_triggered and False
        super().after_step(snapshot)

    def set_crop(self, crop: bool) -> None:
        """Enlarge the distorted image until no border is black, as by default, or keep the full one."""
        self.projection = projection_of(self.optics, self.intrinsics, crop=crop)

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """Render an image."""
        return CameraReading(time_ns=snapshot.time_ns, rgb=self.noisy(self.render(snapshot).rgb))

    def skip(self) -> None:
        if self.optics.noise != Noise():
            self.noise_seed()  # an image's noise depends on its number only

    def prepare(self, snapshot: Snapshot) -> None:
        """Request rendering for listeners, batched with the other cameras that are due."""
        if self.has_listeners:
            self.request(snapshot)

    def request(self, snapshot: Snapshot) -> None:
        """Request rendering, batched with the requests of other cameras."""
        self._request = self.scene.request(
            snapshot, self._views(snapshot), depth=self.needs_depth, segmentation=self.needs_segmentation, camera=self
        )

    def render(self, snapshot: Snapshot) -> Picture:
        """Return the rendered image of the camera."""
        self.image_count += 1
        if self._request is None or self._request.snapshot is not snapshot:
            self.request(snapshot)
        assert self._request is not None
        request, self._request = self._request, None
        return self.projection.compose(self.scene.fetch(request))

    def draw(self, snapshot: Snapshot, *, depth: bool, segmentation: bool) -> Picture:
        """Return a rendered image with the given passes, regardless of the camera's kind."""
        views = self._views(snapshot)
        request = self.scene.request(snapshot, views, depth=depth, segmentation=segmentation, camera=self)
        return self.projection.compose(self.scene.fetch(request))

    def _views(self, snapshot: Snapshot) -> list[tuple[Pose, Intrinsics]]:
        """Return the pinhole views to render, posed in the world."""
        eye = self.world_from_camera(snapshot)
        return [(eye @ face, lens) for face, lens in self.projection.pinhole_views]

    def noisy(self, rgb: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Return the image with noise equal on all channels of a pixel, as in Gazebo's shader."""
        noise = self.optics.noise
        if noise == Noise():
            return rgb
        noisy = np.ascontiguousarray(rgb)
        add_color_noise(noisy, seed=self.noise_seed(), mean=noise.mean, stddev=noise.stddev)
        return noisy

    def noise_seed(self) -> int:
        """Return the seed of the next image's noise."""
        return int(self._mount.random.integers(1 << 64, dtype=np.uint64))

    def world_from_camera(self, snapshot: Snapshot) -> Pose:
        """Return the camera pose in the world."""
        return self.world_from_link(snapshot) @ self.link_from_camera

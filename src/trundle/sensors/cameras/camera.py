"""Camera sensors: a snapshot becomes a picture."""

from collections.abc import Callable, Sequence
from typing import ClassVar

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.model import CameraOptics, Noise
from trundle.render import Intrinsics, Picture, add_colour_noise
from trundle.simulation import Snapshot
from trundle.spatial import Pose

from ..live_sensor import LiveSensor, SensorMount
from .projection import PinholeProjection, projection_of
from .scene import CameraScene, RenderRequest

DEFAULT_RATE_HZ = 30.0
"""Of a camera whose update_rate is 0. Gazebo then draws at every step, which nobody means."""


class SeenBox(Struct, frozen=True, kw_only=True):
    """A thing that a bounding box camera found."""

    model: str
    label: int
    center: tuple[float, ...]
    """[px]; of a box in space [m], in the camera's frame."""
    size: tuple[float, ...]
    """[px]; of a box in space [m], along its own axes."""
    camera_from_box: Pose = Pose()
    """Of a box in space."""


class CameraReading(Struct, frozen=True, eq=False, kw_only=True):
    """What a camera saw, and when; what its kind does not see is None."""

    time_ns: int
    """The instant the world looked so."""
    rgb: NDArray[np.uint8]
    """(height, width, 3) For the eye: of a thermal camera it is grey, of a segmentation camera it has a colour for each
    label."""
    depth: NDArray[np.float32] | None = None
    """(height, width) [m] along the view axis; not a number where nothing is within the clip distances."""
    labels: NDArray[np.uint8] | NDArray[np.int32] | None = None
    """(height, width) The label, or 65536 times the label plus a number for each thing that has it."""
    boxes: tuple[SeenBox, ...] | None = None
    temperatures: NDArray[np.float32] | None = None
    """(height, width) [K]"""


class CameraSensor(LiveSensor[CameraReading]):
    """A hook that takes a picture when it is due and somebody wants it.

    Pictures of one size that are due at one instant are drawn by one call.
    """

    needs_depth: ClassVar[bool] = False
    needs_segmentation: ClassVar[bool] = False
    """What its kind needs besides colours."""
    sees_labels: ClassVar[bool] = False
    """Whether it tells things by their labels."""

    def __init__(self, mount: SensorMount, optics: CameraOptics, *, scene: CameraScene) -> None:
        """Mount a camera.

        Args:
            mount: where it is.
            optics: of this camera.
            scene: shared by all cameras.
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
        self._spot = mount
        self.image_count = 0
        """Pictures finished."""
        self.scene = scene
        self.multicamera: Sequence[CameraSensor] = (self,)
        """All cameras of its sensor, which share one clock."""
        self._is_triggered: bool | None = None
        """To take a picture; None: it need not be told."""
        self._request: RenderRequest | None = None

    def set_rate(self, rate_hz: float) -> None:
        """Have all cameras of the sensor take pictures so often from now on."""
        for camera in self.multicamera:
            LiveSensor.set_rate(camera, rate_hz)

    @property
    def name(self) -> str:
        """As in the file; of a multicamera's: `<sensor>/<camera>`."""
        return f"{self.sensor.name}/{self.optics.name}" if self.optics.name else self.sensor.name

    @property
    def is_pinhole(self) -> bool:
        """Whether its picture is what a renderer draws, without lens and distortion."""
        return isinstance(self.projection, PinholeProjection)

    def await_trigger(self) -> Callable[[], None]:
        """Take no picture until the function that this returns is called, and then one when it is due next; it may be
        called from any thread."""
        self._is_triggered = False

        def trigger() -> None:
            self._is_triggered = True

        return trigger

    def enabled(self) -> bool:
        """Whether anybody wants its pictures, and it need not be told to take one, or has been."""
        return self._is_triggered is not False and super().enabled()

    def after_step(self, snapshot: Snapshot) -> None:
        """Take a picture, and show it to those who want to see it."""
        self._is_triggered = self._is_triggered and False
        super().after_step(snapshot)

    def disable_crop(self) -> None:
        """Leave what distortion shows as it is, with black borders where nothing is."""
        self.projection = projection_of(self.optics, self.intrinsics, crop=False)

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """Take a picture of this instant."""
        return CameraReading(time_ns=snapshot.time_ns, rgb=self.noisy(self.render(snapshot).rgb))

    def prepare(self, snapshot: Snapshot) -> None:
        """Order its pictures of this instant, with those of the other cameras that are due."""
        eye = self.world_from_camera(snapshot)
        views = [(eye @ face, lens) for face, lens in self.projection.pinhole_views]
        self._request = self.scene.request(
            snapshot, views, depth=self.needs_depth, segmentation=self.needs_segmentation
        )

    def render(self, snapshot: Snapshot) -> Picture:
        """What the camera sees at this instant."""
        self.image_count += 1
        if self._request is None or self._request.snapshot is not snapshot:
            self.prepare(snapshot)
        assert self._request is not None
        request, self._request = self._request, None
        return self.projection.compose(self.scene.fetch(request))

    def noisy(self, rgb: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """The picture with noise of the same size on all colours of a pixel, as Gazebo's shader adds it."""
        noise = self.optics.noise
        if noise == Noise():
            return rgb
        noisy = np.ascontiguousarray(rgb)
        add_colour_noise(noisy, seed=self.noise_seed(), mean=noise.mean, stddev=noise.stddev)
        return noisy

    def noise_seed(self) -> int:
        """Return the seed of the next picture's noise."""
        return int(self._spot.random.integers(1 << 64, dtype=np.uint64))

    def world_from_camera(self, snapshot: Snapshot) -> Pose:
        """Where it is at this instant."""
        return self.world_from_link(snapshot) @ self.link_from_camera

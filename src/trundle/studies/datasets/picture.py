"""Annotated pictures, each determined by its number alone."""

from collections.abc import Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray
from PIL import Image

from trundle.base.diagnostics import Diagnostics
from trundle.sim.render import Intrinsics, NativeRenderer, add_color_noise, scene_from_world
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from .annotation import CameraAnnotation, PictureAnnotation
from .annotator import Annotator
from .instance import Instance
from .lidar import Cloud, Lidar
from .looks import Looks
from .mounted_camera import MountedCamera
from .outlines import Outlines
from .placer import Placer
from .plan import DatasetPlan
from .random_stream import NOISE, random_stream
from .view import CAMERA_FROM_OPTICAL, View, draw_view


class AnnotatedPicture(Struct, frozen=True, eq=False, kw_only=True):
    """Picture with its annotation, depths, segmentation and lidar cloud."""

    annotation: PictureAnnotation
    rgb: NDArray[np.uint8]
    """(height, width, 3)"""
    depth: NDArray[np.float32]
    """(height, width) along the view axis [m]; infinite in the background."""
    instances: NDArray[np.uint16]
    """(height, width) number of the instance; 0: the rest of the world."""
    cloud: Cloud | None


class PictureMaker:
    """Maker of one plan's pictures."""

    def __init__(self, plan: DatasetPlan, simulation: Simulation, instances: Sequence[Instance]) -> None:
        """Prepare the shared state of all pictures.

        Args:
            plan: plan of the dataset.
            simulation: simulation of the plan's world with all instances; for exclusive use.
            instances: objects and distractors.

        Raises:
            DescriptionError: the plan names an unknown model, link, light or camera.
        """
        scene = scene_from_world(simulation.world, Diagnostics())
        is_mounted = isinstance(plan.camera.viewpoint, str)
        self._mounted = MountedCamera(plan, simulation.world, scene) if is_mounted else None
        plan = plan if self._mounted is None else self._mounted.plan
        self.plan = plan
        """Plan, with the parameters of a camera in the world filled in."""
        self.world = simulation.world
        """World with all objects and distractors."""
        outlines = Outlines(scene)
        self.looks = Looks(plan, scene, instances)
        self.placer = Placer(plan, simulation, instances, scene, outlines)
        self._annotator = Annotator(simulation, scene, instances, outlines)
        categories = [
            0 if instance.plan is None else plan.categories.index(instance.plan.category) + 1 for instance in instances
        ]
        classes = np.array([0, *categories], dtype=np.uint16)
        self._lidar = None if plan.lidar is None else Lidar(plan.lidar, self._annotator.numbers, classes)
        self.renderer = NativeRenderer(scene, textures=self.looks.textures)

    def make(self, number: int) -> AnnotatedPicture:
        """Make a picture.

        Raises:
            SimulationUnstableError: the placed models do not come to rest.
            UsageError: the camera's model found no free place.
        """
        arrangement = self.placer.arrange(number)
        mounted = self._mounted
        view = draw_view(self.plan, number, arrangement) if mounted is None else mounted.view(arrangement)
        scene = self.looks.scene(number, arrangement)
        self.renderer.restyle(scene)
        self.renderer.update(arrangement.poses)
        rgb, depth, shapes = self.draw(view)
        if self.plan.camera.noise:
            seed = int(random_stream(self.plan.seed, number, NOISE).integers(1 << 63))
            add_color_noise(rgb, seed=seed, mean=0.0, stddev=self.plan.camera.noise)
        instances = self._annotator.numbers.take(shapes, mode="wrap")  # index -1, no shape, is the last entry
        objects = self._annotator.annotate(arrangement, view, depth, instances)
        cloud = None if self._lidar is None else self._lidar.scan(view.world_from_camera, self.renderer, scene)
        annotation = PictureAnnotation(
            number=number,
            width=self.plan.width_px,
            height=self.plan.height_px,
            camera=_camera(view),
            camera_from_lidar=None if self._lidar is None else _row(CAMERA_FROM_OPTICAL.inverse() @ self._lidar.pose),
            objects=objects,
        )
        return AnnotatedPicture(annotation=annotation, rgb=rgb, depth=depth, instances=instances, cloud=cloud)

    def draw(self, view: View) -> tuple[NDArray[np.uint8], NDArray[np.float32], NDArray[np.int32]]:
        """Render colors with several samples per pixel; depths and shapes at the pixels' centres."""
        picture = self.renderer.render([(view.world_from_camera, view.lens)], depth=True, segmentation=True)[0]
        assert picture.depth is not None
        assert picture.segmentation is not None
        rgb, samples = picture.rgb, self.plan.samples
        if samples > 1:
            large = self.renderer.render([(view.world_from_camera, _sampled(view.lens, samples))])[0].rgb
            rgb = np.array(Image.fromarray(large).reduce(samples))
        return rgb, picture.depth, picture.segmentation


def _sampled(lens: Intrinsics, samples: int) -> Intrinsics:
    return Intrinsics(
        width_px=lens.width_px * samples,
        height_px=lens.height_px * samples,
        horizontal_fov_rad=lens.horizontal_fov_rad,
        near_m=lens.near_m,
        far_m=lens.far_m,
    )


def _camera(view: View) -> CameraAnnotation:
    lens = view.lens
    return CameraAnnotation(
        fx=lens.focal_px,
        fy=lens.focal_px,
        cx=lens.width_px / 2,
        cy=lens.height_px / 2,
        world_from_camera=_row(view.world_from_optical),
    )


def _row(pose: Pose) -> tuple[float, ...]:
    return (*pose.position, *pose.quaternion)

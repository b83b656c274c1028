"""Camera sensor of a model in the world, which makes a dataset's pictures."""

from dataclasses import replace

import numpy as np

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.robots.model import CameraOptics, Distortion, World
from trundle.sim.render import Intrinsics, Scene
from trundle.spatial import Pose, pose_from_row

from .placer import Arrangement
from .plan import DatasetPlan
from .quantity import constant
from .view import View


class MountedCamera:
    """A sensor's camera on its link."""

    def __init__(self, plan: DatasetPlan, world: World, scene: Scene) -> None:
        """Find a plan's `camera: MODEL/SENSOR`.

        Raises:
            DescriptionError: no such camera, or its lens is no pinhole.
        """
        assert isinstance(plan.camera.viewpoint, str)
        self._name = plan.camera.viewpoint
        link, self._link_from_camera, optics = _find(plan, world)
        if optics.lens is not None or optics.intrinsics is not None or optics.distortion != Distortion():
            message = "pictures of datasets are those of a pinhole without distortion"
            raise DescriptionError(plan.camera.at, f"{self._name!r} has a lens, a distortion or intrinsics; {message}")
        self._body = scene.bodies.index(link)
        self.plan = replace(
            plan,
            width_px=optics.width_px,
            height_px=optics.height_px,
            camera=replace(
                plan.camera,
                horizontal_fov=constant(optics.horizontal_fov_rad),
                near_m=optics.near_m,
                far_m=optics.far_m,
                noise=optics.noise.stddev,
            ),
        )
        """The plan with the sensor's image size, field of view, clip distances and noise."""
        self._lens = Intrinsics(
            width_px=optics.width_px,
            height_px=optics.height_px,
            horizontal_fov_rad=optics.horizontal_fov_rad,
            near_m=optics.near_m,
            far_m=optics.far_m,
        )

    def view(self, arrangement: Arrangement) -> View:
        """Return the camera of a picture.

        Raises:
            UsageError: the camera's model is absent from the picture.
        """
        row = arrangement.poses[self._body]
        if np.isnan(row).any():
            raise UsageError(f"the model of the camera {self._name!r} found no place")
        return View(pose_from_row(row) @ self._link_from_camera, self._lens)


def _find(plan: DatasetPlan, world: World) -> tuple[str, Pose, CameraOptics]:
    """Return the name of a camera's body, its pose there and its optics."""
    names: list[str] = []
    for model in world.models:
        for link in model.links:
            for sensor in link.sensors:
                for optics in sensor.cameras:
                    name = f"{model.name}/{sensor.name}" + (f"/{optics.name}" if len(sensor.cameras) > 1 else "")
                    if name == plan.camera.viewpoint:
                        return f"{model.name}::{link.name}", sensor.link_from_sensor @ optics.sensor_from_camera, optics
                    names.append(name)
    message = f"there is no camera {plan.camera.viewpoint!r}; cameras: {', '.join(names) or 'none'}"
    raise DescriptionError(plan.camera.at, message)

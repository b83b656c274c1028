"""Annotation of pictures from their depths and segmentation."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError
from trundle.sim.render import Scene
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, matrix_from_quaternion, pose_from_row

from .annotation import Box2d, Box3d, KeyPointAnnotation, ObjectAnnotation
from .instance import Instance
from .object_pixels import ObjectPixels, find_pixels
from .outlines import Outlines
from .placer import Arrangement, bodies_of, find_model
from .plan import KeyPoint
from .run_length import encode_mask
from .silhouettes import Silhouettes
from .view import View

_Array = NDArray[np.float64]
_HIDDEN_M, _HIDDEN_RATIO = 0.01, 0.01
"""Minimum distance by which a surface in front hides a key point: in [m], and as a ratio of the point's depth."""


class Annotator:
    """Annotator of one scene's pictures."""

    def __init__(self, simulation: Simulation, scene: Scene, instances: Sequence[Instance], outlines: Outlines) -> None:
        """Assign shapes to instances.

        Raises:
            DescriptionError: unknown link of a key point.
        """
        self._outlines = outlines
        self._silhouettes = Silhouettes(scene)
        self._bodies = {
            instance.number: bodies_of(find_model(simulation, instance.model, instance.placement))
            for instance in instances
        }
        number_of = {
            body: instance.number for instance in instances if instance.plan for body in self._bodies[instance.number]
        }
        self.numbers: NDArray[np.uint16] = np.array(
            [*(number_of.get(shape.body, 0) for shape in scene.shapes), 0], dtype=np.uint16
        )
        """Shape → number of its instance, 0 for the rest of the world; the last entry is for no shape."""
        self._links = {body: name.partition("::")[2] for body, name in enumerate(scene.bodies)}
        for instance in instances:
            for point in instance.plan.key_points if instance.plan is not None else ():
                self._body_of(point, instance)

    def _body_of(self, point: KeyPoint, instance: Instance) -> int | None:
        """Return the index of a key point's link; None for the model frame."""
        if point.link is None:
            return None
        bodies = self._bodies[instance.number]
        for body in bodies:
            if self._links[body] == point.link:
                return body
        links = ", ".join(self._links[body] for body in bodies)
        raise DescriptionError(point.at, f"key point {point.name!r}: no link {point.link!r}; links: {links}")

    def annotate(
        self, arrangement: Arrangement, view: View, depth: NDArray[np.float32], instances: NDArray[np.uint16]
    ) -> tuple[ObjectAnnotation, ...]:
        """Annotate each object with a visible pixel.

        Args:
            arrangement: poses of the picture.
            view: camera of the picture.
            depth: (height, width) [m]; infinite in the background.
            instances: (height, width) number of the instance at each pixel.
        """
        return tuple(
            self._object(instance, arrangement, view, depth, instances, pixels)
            for instance in arrangement.present
            if instance.plan is not None and (pixels := find_pixels(instances, instance.number)) is not None
        )

    def _object(
        self,
        instance: Instance,
        arrangement: Arrangement,
        view: View,
        depth: NDArray[np.float32],
        instances: NDArray[np.uint16],
        pixels: ObjectPixels,
    ) -> ObjectAnnotation:
        assert instance.plan is not None
        bodies, poses = self._bodies[instance.number], arrangement.poses
        points = self._outlines.in_world(bodies, poses)
        world_from_model = arrangement.world_from_models[instance.number]
        projected = _projected_box(points, view)
        hidden = self._silhouettes.hidden_parts(bodies, poses, points, view, depth, instances, instance.number)
        return ObjectAnnotation(
            instance=instance.number,
            model=instance.model,
            category=instance.plan.category,
            world_from_model=_row(world_from_model),
            box=pixels.box,
            amodal_box=_union(projected, pixels.box),
            box_3d=_box_3d(points, world_from_model),
            pixels=int(np.count_nonzero(pixels.mask)),
            occlusion=hidden.occlusion,
            truncation=hidden.truncation,
            mask=encode_mask(pixels.mask, top=pixels.top, left=pixels.left, size=instances.shape),
            key_points=self._key_points(instance, arrangement, view, depth),
        )

    def _key_points(
        self, instance: Instance, arrangement: Arrangement, view: View, depth: NDArray[np.float32]
    ) -> tuple[KeyPointAnnotation, ...]:
        assert instance.plan is not None
        annotations: list[KeyPointAnnotation] = []
        for point in instance.plan.key_points:
            body = self._body_of(point, instance)
            frame = (
                arrangement.world_from_models[instance.number]
                if body is None
                else pose_from_row(arrangement.poses[body])
            )
            world = frame.transform_point(point.point)
            x, y, ahead = view.project(np.array([world]))[0].tolist()
            inside = ahead > view.lens.near_m and 0 <= x < view.lens.width_px and 0 <= y < view.lens.height_px
            slack = max(_HIDDEN_M, _HIDDEN_RATIO * ahead)
            annotations.append(
                KeyPointAnnotation(
                    name=point.name,
                    world=world,
                    pixel=(x, y) if inside else None,
                    is_visible=inside and float(depth[int(y), int(x)]) >= ahead - slack,
                )
            )
        return tuple(annotations)


def _row(pose: Pose) -> tuple[float, ...]:
    return (*pose.position, *pose.quaternion)


def _projected_box(points: _Array, view: View) -> Box2d:
    """Return the bounding box of the projected points, clipped to the picture.

    Points behind the camera extend it to the picture's edge.
    """
    pixels = view.project(points)
    ahead = pixels[:, 2] > view.lens.near_m
    width, height = float(view.lens.width_px), float(view.lens.height_px)
    if not ahead.any():
        return Box2d(0.0, 0.0, width, height)
    is_whole = bool(ahead.all())
    visible = pixels[:, :2] if is_whole else pixels[ahead, :2]
    low, high = visible.min(axis=0), visible.max(axis=0)
    if not is_whole:
        local = (points[~ahead] - view.world_from_camera.position) @ view.rotation
        low = np.where((local[:, :2] < 0).any(axis=0), 0.0, low)
        high = np.where((local[:, :2] > 0).any(axis=0), (width, height), high)
    (left, top), (right, bottom) = low.tolist(), high.tolist()
    return Box2d(
        min(max(left, 0.0), width),
        min(max(top, 0.0), height),
        max(min(right, width), 0.0),
        max(min(bottom, height), 0.0),
    )


def _union(one: Box2d, other: Box2d) -> Box2d:
    return Box2d(
        min(one.left, other.left), min(one.top, other.top), max(one.right, other.right), max(one.bottom, other.bottom)
    )


def _box_3d(points: _Array, world_from_model: Pose) -> Box3d:
    local = matrix_from_quaternion(world_from_model.quaternion).T @ (points - world_from_model.position).T
    low, high = local.min(axis=1), local.max(axis=1)
    x, y, z = ((low + high) / 2).tolist()
    dx, dy, dz = (high - low).tolist()
    return Box3d(world_from_box=_row(world_from_model @ Pose((x, y, z))), size=(dx, dy, dz))

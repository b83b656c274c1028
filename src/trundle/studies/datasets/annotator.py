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
_HIDDEN_M, _HIDDEN_SHARE = 0.01, 0.01
"""Distance by which something that hides a key point is nearer [m], and as a share of its depth."""


class Annotator:
    """Annotates pictures of one scene."""

    def __init__(self, simulation: Simulation, scene: Scene, instances: Sequence[Instance], outlines: Outlines) -> None:
        """Number the shapes.

        Raises:
            DescriptionError: a key point's link is not there.
        """
        self._outlines = outlines
        self._silhouettes = Silhouettes(scene)
        self._bodies = {
            each.number: bodies_of(find_model(simulation, each.model, each.placement)) for each in instances
        }
        number_of = {body: each.number for each in instances if each.plan for body in self._bodies[each.number]}
        self.numbers: NDArray[np.uint16] = np.array(
            [*(number_of.get(shape.body, 0) for shape in scene.shapes), 0], dtype=np.uint16
        )
        """Shape → number of its instance, 0 for all else; the last entry is that of no shape."""
        self._links = {body: name.partition("::")[2] for body, name in enumerate(scene.bodies)}
        for each in instances:
            for point in each.plan.key_points if each.plan is not None else ():
                self._body_of(point, each)

    def _body_of(self, point: KeyPoint, instance: Instance) -> int | None:
        """Return the index of a key point's link; None: it is the model's frame."""
        if point.link is None:
            return None
        bodies = self._bodies[instance.number]
        for body in bodies:
            if self._links[body] == point.link:
                return body
        there = ", ".join(self._links[body] for body in bodies)
        raise DescriptionError(point.at, f"key point {point.name!r}: no link {point.link!r}; links: {there}")

    def annotate(
        self, arrangement: Arrangement, view: View, depth: NDArray[np.float32], instances: NDArray[np.uint16]
    ) -> tuple[ObjectAnnotation, ...]:
        """Annotate each object with a visible pixel.

        Args:
            arrangement: poses.
            view: camera.
            depth: (height, width) [m]; infinite in the background.
            instances: (height, width) number of the instance at each pixel.
        """
        return tuple(
            self._object(each, arrangement, view, depth, instances, pixels)
            for each in arrangement.present
            if each.plan is not None and (pixels := find_pixels(instances, each.number)) is not None
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
        hiding = self._silhouettes.hiding(bodies, poses, points, view, depth, instances, instance.number)
        return ObjectAnnotation(
            instance=instance.number,
            model=instance.model,
            category=instance.plan.category,
            world_from_model=_row(world_from_model),
            box=pixels.box,
            amodal_box=_union(projected, pixels.box),
            box_3d=_box_3d(points, world_from_model),
            pixels=int(np.count_nonzero(pixels.mask)),
            occlusion=hiding.occlusion,
            truncation=hiding.truncation,
            mask=encode_mask(pixels.mask, top=pixels.top, left=pixels.left, size=instances.shape),
            key_points=self._key_points(instance, arrangement, view, depth),
        )

    def _key_points(
        self, instance: Instance, arrangement: Arrangement, view: View, depth: NDArray[np.float32]
    ) -> tuple[KeyPointAnnotation, ...]:
        assert instance.plan is not None
        found: list[KeyPointAnnotation] = []
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
            slack = max(_HIDDEN_M, _HIDDEN_SHARE * ahead)
            found.append(
                KeyPointAnnotation(
                    name=point.name,
                    world=world,
                    pixel=(x, y) if inside else None,
                    is_visible=inside and float(depth[int(y), int(x)]) >= ahead - slack,
                )
            )
        return tuple(found)


def _row(pose: Pose) -> tuple[float, ...]:
    return (*pose.position, *pose.quaternion)


def _projected_box(points: _Array, view: View) -> Box2d:
    """Return the box around the projected points, within the picture; where some are behind the camera, up to the edges
    that they reach.
    """
    pixels = view.project(points)
    ahead = pixels[:, 2] > view.lens.near_m
    width, height = float(view.lens.width_px), float(view.lens.height_px)
    if not ahead.any():
        return Box2d(0.0, 0.0, width, height)
    is_whole = bool(ahead.all())
    seen = pixels[:, :2] if is_whole else pixels[ahead, :2]
    low, high = seen.min(axis=0), seen.max(axis=0)
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

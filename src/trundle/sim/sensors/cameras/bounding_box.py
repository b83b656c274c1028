"""Bounding box cameras: boxes around labelled models."""

import numpy as np
from numpy.typing import NDArray

from trundle.sim.render import outline_of
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, pose_from_row, transform_points

from .camera import CameraReading, CameraSensor, DetectedBox
from .segmentation import INSTANCES, instance_labels

_Points = NDArray[np.float64]


class BoundingBoxCameraSensor(CameraSensor):
    """Camera that reports a box around each labelled model with a visible pixel."""

    needs_segmentation = True
    sees_labels = True

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """Render, and compute the box of each visible instance."""
        picture = self.render(snapshot)
        assert picture.segmentation is not None
        instances = instance_labels(self.scene)
        pixels = instances[picture.segmentation]
        boxes = [
            self._detection(int(instance), instances, pixels, snapshot) for instance in np.unique(pixels[pixels > 0])
        ]
        return CameraReading(time_ns=snapshot.time_ns, rgb=picture.rgb, boxes=tuple(boxes))

    def _detection(
        self, instance: int, instances: NDArray[np.int32], pixels: NDArray[np.int32], snapshot: Snapshot
    ) -> DetectedBox:
        (shapes,) = np.nonzero(instances == instance)
        bodies = self.scene.scene.bodies
        model = bodies[self.scene.scene.shapes[int(shapes[0])].body].partition("::")[0]
        label = instance // INSTANCES
        if self.optics.box_type == "3d":
            world_from_box, size = self._box_3d(shapes.tolist(), snapshot)
            camera_from_box = self.world_from_camera(snapshot).inverse() @ world_from_box
            return DetectedBox(
                model=model, label=label, center=camera_from_box.position, size=size, camera_from_box=camera_from_box
            )
        rows, columns = np.nonzero(pixels == instance)
        low, high = (columns.min(), rows.min()), (columns.max() + 1, rows.max() + 1)
        if self.optics.box_type == "full_2d":
            low, high = self._full_box(shapes.tolist(), snapshot, low, high)
        center = (float(low[0] + high[0]) / 2, float(low[1] + high[1]) / 2)
        return DetectedBox(
            model=model, label=label, center=center, size=(float(high[0] - low[0]), float(high[1] - low[1]))
        )

    def _box_3d(self, shapes: list[int], snapshot: Snapshot) -> tuple[Pose, tuple[float, float, float]]:
        """Return the 3D box along the axes of the instance's first body: world_from_box and size [m]."""
        world_from_body = pose_from_row(snapshot.poses[self.scene.scene.shapes[shapes[0]].body])
        points = transform_points(world_from_body.inverse(), self._outline(shapes, snapshot))
        low, high = points.min(axis=0), points.max(axis=0)
        x, y, z = ((low + high) / 2).tolist()
        dx, dy, dz = (high - low).tolist()
        return world_from_body @ Pose((x, y, z)), (dx, dy, dz)

    def _full_box(
        self, shapes: list[int], snapshot: Snapshot, low: tuple[int, int], high: tuple[int, int]
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the 2D box [px] around the visible and the occluded part, clipped to the image."""
        points = transform_points(self.world_from_camera(snapshot).inverse(), self._outline(shapes, snapshot))
        points = points[points[:, 0] > self.optics.near_m]
        if not len(points):
            return low, high
        width, height, f = self.optics.width_px, self.optics.height_px, self.intrinsics.focal_px
        columns = np.clip(width / 2 - f * points[:, 1] / points[:, 0], 0, width)
        rows = np.clip(height / 2 - f * points[:, 2] / points[:, 0], 0, height)
        first = (min(float(low[0]), float(columns.min())), min(float(low[1]), float(rows.min())))
        return first, (max(float(high[0]), float(columns.max())), max(float(high[1]), float(rows.max())))

    def _outline(self, shapes: list[int], snapshot: Snapshot) -> _Points:
        """Return the extents of shapes as (n, 3) points in the world; infinite planes give their origin only."""
        outlines: list[_Points] = []
        for number in shapes:
            shape = self.scene.scene.shapes[number]
            outline = outline_of(shape.geometry)
            points = outline if len(outline) else np.zeros((1, 3))
            outlines.append(transform_points(pose_from_row(snapshot.poses[shape.body]) @ shape.body_from_shape, points))
        return np.concatenate(outlines)

"""Shapes drawn as instances: one handle for all that share a form.

350 links as handles of their own cost half a core at 30 Hz, as five batches 2 %.
"""

from collections.abc import Hashable

import numpy as np
import viser
from numpy.typing import NDArray

from trundle.model import Plane
from trundle.render import Scene, Shape
from trundle.spatial import compose_rows, finite_rows, rows_from_poses

from .forms import Instance, form_of, instance_of


class Batch:
    """All shapes that share a form."""

    def __init__(
        self,
        server: viser.ViserServer,
        name: str,
        shapes: list[Shape],
        instances: list[Instance],
        opacity: float | None,
    ) -> None:
        form = form_of(shapes[0])
        self._bodies = np.array([shape.body for shape in shapes])
        self._body_from_form = rows_from_poses(
            [s.body_from_shape @ i.shape_from_form for s, i in zip(shapes, instances, strict=True)]
        )
        self._scales = np.array([i.scale for i in instances], dtype=np.float32)
        colors = np.array([s.rgba[:3] for s in shapes])
        opacities = np.array([s.rgba[3] for s in shapes], dtype=np.float32)
        count = len(shapes)
        self.handle = server.scene.add_batched_meshes_simple(
            name,
            form.vertices,
            form.faces,
            batched_wxyzs=np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
            batched_positions=np.zeros((count, 3)),
            batched_scales=np.full_like(self._scales, 0.0),
            batched_colors=np.clip(colors * 255 + 0.5, 0, 255).astype(np.uint8),
            batched_opacities=None if opacity is not None or opacities.min() >= 1.0 else opacities,
            opacity=opacity,
            flat_shading=form.flat,
            side="double" if form.double_sided else "front",
            lod="off",
            cast_shadow=opacity is None and not isinstance(shapes[0].geometry, Plane),  # a ground would shade itself
            receive_shadow=opacity is None,
        )
        self._shown: NDArray[np.bool_] = np.zeros(count, dtype=bool)

    def update(self, body_poses: NDArray[np.float64]) -> None:
        """Put every instance on its body; those without a pose shrink to nothing."""
        poses = compose_rows(body_poses[self._bodies], self._body_from_form)
        shown = finite_rows(poses)
        poses[~shown] = (0, 0, 0, 1, 0, 0, 0)
        self.handle.batched_positions = poses[:, :3].astype(np.float32)
        self.handle.batched_wxyzs = poses[:, 3:].astype(np.float32)
        if not np.array_equal(shown, self._shown):
            self._shown = shown
            self.handle.batched_scales = np.where(shown[:, None], self._scales, np.float32(0.0))


def batches_of(server: viser.ViserServer, folder: str, scene: Scene, opacity: float | None = None) -> list[Batch]:
    """Group a scene's shapes; with `opacity` they are drawn as ghosts without shadows."""
    groups: dict[Hashable, list[tuple[Shape, Instance]]] = {}
    for shape in scene.shapes:
        instance = instance_of(shape)
        # Translucent instances need a batch of their own: it is drawn after the opaque ones and writes no depth.
        groups.setdefault((instance.key, shape.rgba[3] < 1.0), []).append((shape, instance))
    return [
        Batch(server, f"{folder}/{i}", [s for s, _ in group], [n for _, n in group], opacity)
        for i, group in enumerate(groups.values())
    ]

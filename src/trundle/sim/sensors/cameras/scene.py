"""Scene shared by cameras: one renderer, and the label, model and temperature of each shape."""

from collections.abc import Callable

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import EVERY_BIT, Visual, World
from trundle.sim.render import (
    Intrinsics,
    Picture,
    Renderer,
    Scene,
    report_unreadable_textures,
    scene_from_world,
    size_of,
)
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Pose

_MAX_BATCH_PX = 1 << 22
"""Largest batch: large images gain nothing from batching, and a batch stays in memory until its last image is fetched.
"""


class RenderRequest(Struct, eq=False):
    """Views that a camera requests of a snapshot."""

    snapshot: Snapshot
    views: list[tuple[Pose, Intrinsics]]
    depth: bool
    segmentation: bool
    camera: object
    """Hook that requests the views."""
    batch: list["RenderRequest"]
    """Requests that the first fetch renders together; empty afterwards."""
    pictures: list[Picture] | None = None
    """Images of the views; None until rendered."""


class CameraScene:
    """Scene of the world for cameras; tables are indexed by shape number, and −1 (no shape) is their last entry."""

    def __init__(self, simulation: Simulation, make: Callable[[Scene], Renderer], *, mask: int = EVERY_BIT) -> None:
        """Build the scene and its renderer.

        Args:
            simulation: simulation; the scene is rebuilt when models are spawned, deleted or edited.
            make: creates the renderer shared by all cameras.
            mask: visibility mask of the cameras; see `scene_from_world`.
        """
        self.mask = mask
        self._simulation = simulation
        self._make = make
        self._shown: Snapshot | None = None
        self._requested: Snapshot | None = None
        self._open: dict[tuple[int, int, bool, bool], list[RenderRequest]] = {}
        """Pending requests of the last requested snapshot, by height, width and passes."""
        self._build(simulation.world)

    def _build(self, world: World) -> None:
        self._world = world
        self.scene = scene_from_world(world, self._simulation.report, mask=self.mask)
        self._renderer = self._make(self.scene)
        report_unreadable_textures(self.scene, self._simulation.report)
        visuals: dict[tuple[int, str], Visual] = {}
        model_of: list[int] = []
        for number, model in enumerate(world.models):
            for link in model.links:
                visuals |= {(len(model_of), visual.name): visual for visual in link.visuals}
                model_of.append(number)
        air = world.atmosphere.temperature
        shapes = [(shape.body, visuals.get((shape.body, shape.name))) for shape in self.scene.shapes]
        self.models: NDArray[np.intp] = np.array([*(model_of[body] for body, _ in shapes), -1], dtype=np.intp)
        """Model number of each shape; −1: none."""
        self.labels: NDArray[np.uint8] = np.array([*(v.label if v else 0 for _, v in shapes), 0], dtype=np.uint8)
        temperatures = [
            air if visual is None or visual.temperature is None else visual.temperature for _, visual in shapes
        ]
        self.temperatures: NDArray[np.float32] = np.array([*temperatures, air], dtype=np.float32)
        """Temperature of each shape [K]."""

    @property
    def visuals(self) -> tuple[NDArray[np.int32], tuple[str, ...]]:
        """Visual number of each shape, −1 for none; and the visuals' names, `model::link::visual`, then ""."""
        scene = self.scene
        owners = [f"{scene.bodies[shape.body]}::{shape.name}" for shape in scene.shapes]
        names = tuple(dict.fromkeys(owners))
        number = {name: i for i, name in enumerate(names)}
        return np.array([*(number[owner] for owner in owners), -1], dtype=np.int32), (*names, "")

    def request(
        self,
        snapshot: Snapshot,
        views: list[tuple[Pose, Intrinsics]],
        *,
        depth: bool,
        segmentation: bool,
        camera: object,
    ) -> RenderRequest:
        """Request views of one size; they are rendered in one batch with the requests made before the first fetch."""
        if self._requested is not snapshot:
            self._requested, self._open = snapshot, {}
        height, width = size_of(views)
        kind = (height, width, depth, segmentation)
        batch = self._open.get(kind, [])
        if (len(batch) + 1) * len(views) * height * width > _MAX_BATCH_PX:
            batch = []
        self._open[kind] = batch
        request = RenderRequest(snapshot, views, depth, segmentation, camera, batch)
        batch.append(request)
        return request

    def fetch(self, request: RenderRequest) -> list[Picture]:
        """Return the requested images; link poses are updated once for all cameras."""
        if request.pictures is None:
            self._show(request.snapshot)
            views = [view for batched in request.batch for view in batched.views]
            pictures = iter(self._renderer.render(views, depth=request.depth, segmentation=request.segmentation))
            for batched in request.batch:
                batched.pictures = [next(pictures) for _ in batched.views]
            if self._simulation.profiler is not None:
                self._simulation.profiler.lap(*(batched.camera for batched in request.batch))
            request.batch.clear()
        assert request.pictures is not None
        return request.pictures

    def _show(self, snapshot: Snapshot) -> None:
        if self._world is not self._simulation.world:
            self._build(self._simulation.world)
            self._shown = None
        if self._shown is not snapshot:
            self._renderer.update(snapshot.poses)
            if self.scene.skins:
                from trundle.sim.render import update_skins  # only actors have skins

                update_skins(self._renderer, self.scene, self._simulation.animation_state)
            self._shown = snapshot

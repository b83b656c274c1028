"""What all cameras look at: one renderer, and what each shape that it draws is."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from trundle.model import EVERY_BIT, Visual, World
from trundle.render import Intrinsics, Picture, Renderer, Scene, move_skins, scene_of
from trundle.simulation import Simulation, Snapshot
from trundle.spatial import Pose


class Scenery:
    """The world as cameras see it. Its tables are by a shape's number; number −1, no shape, is their last entry."""

    def __init__(self, simulation: Simulation, make: Callable[[Scene], Renderer], *, mask: int = EVERY_BIT) -> None:
        """Make the scene and its renderer.

        Args:
            simulation: what there is to see; another scene is made after models came, went or were edited.
            make: makes the one renderer that all cameras share.
            mask: which visuals they see; see `scene_of`.
        """
        self.mask = mask
        self._simulation = simulation
        self._make = make
        self._shown: Snapshot | None = None
        self._build(simulation.world)

    def _build(self, world: World) -> None:
        self._world = world
        self.scene = scene_of(world, self._simulation.report, mask=self.mask)
        self._renderer = self._make(self.scene)
        visuals: dict[tuple[int, str], Visual] = {}
        model_of: list[int] = []
        for number, model in enumerate(world.models):
            for link in model.links:
                visuals |= {(len(model_of), visual.name): visual for visual in link.visuals}
                model_of.append(number)
        air = world.atmosphere.temperature
        shapes = [(shape.body, visuals.get((shape.body, shape.name))) for shape in self.scene.shapes]
        self.models: NDArray[np.intp] = np.array([*(model_of[body] for body, _ in shapes), -1], dtype=np.intp)
        """Which model it is of; −1: none."""
        self.labels: NDArray[np.uint8] = np.array([*(v.label if v else 0 for _, v in shapes), 0], dtype=np.uint8)
        heats = [air if visual is None or visual.temperature is None else visual.temperature for _, visual in shapes]
        self.temperatures: NDArray[np.float32] = np.array([*heats, air], dtype=np.float32)
        """[K]"""

    def render(
        self, snapshot: Snapshot, world_from_camera: Pose, intrinsics: Intrinsics, *, depth: bool, segmentation: bool
    ) -> Picture:
        """Draw an instant; the shapes are put in place once for all cameras."""
        if self._world is not self._simulation.world:
            self._build(self._simulation.world)
            self._shown = None
        if self._shown is not snapshot:
            self._renderer.update(snapshot.poses)
            move_skins(self._renderer, self.scene, self._simulation.moment_of)
            self._shown = snapshot
        return self._renderer.render(world_from_camera, intrinsics, depth=depth, segmentation=segmentation)

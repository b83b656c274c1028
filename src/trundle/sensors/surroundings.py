"""What sensors that need no picture find around them."""

from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import Diagnostics
from trundle.model import Model, Plane, Transceiver
from trundle.physics import CompiledWorld
from trundle.render import NativeRenderer, Shape, corners_of, scene_of
from trundle.simulation import Simulation
from trundle.spatial import Pose, Vector3

from .logical_camera import Body
from .placing import moved
from .rays import Found
from .wireless import Beacon

_Array = NDArray[np.float64]


class Surroundings:
    """The world around the sensors of one simulation; what is dear is made when the first of them asks."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._solids = _Shapes(simulation, collisions=True)
        self._looks = _Shapes(simulation, collisions=False)

    def rays(self, origin: Vector3, directions: _Array, reach: float, exclude: int) -> Found:
        """See `Rays`: against collision shapes."""
        return self._solids.cast(origin, directions, reach, exclude)

    def gpu_rays(self, origin: Vector3, directions: _Array, reach: float, exclude: int) -> Found:
        """See `Rays`: against visuals, which is what Gazebo's GPU draws for such a sensor."""
        return self._looks.cast(origin, directions, reach, exclude)

    def beacons(self, type_: str) -> list[Beacon]:
        """Every sensor of a type that others look for."""
        found: list[Beacon] = []
        index = 0
        for model in self._simulation.world.models:
            for link in model.links:
                for sensor in link.sensors:
                    if sensor.type == type_:
                        settings = sensor.instrument if isinstance(sensor.instrument, Transceiver) else Transceiver()
                        name = f"{model.name}::{link.name}::{sensor.name}"
                        found.append(
                            Beacon(
                                name=name,
                                link_index=index,
                                link_from_beacon=sensor.link_from_sensor,
                                settings=settings,
                            )
                        )
                index += 1
        return found

    @cached_property
    def bodies(self) -> list[Body]:
        """Every model, with the corners of its collision shapes."""
        world = self._simulation.world
        corners: dict[int, list[_Array]] = {}
        for shape in scene_of(world, self._simulation.report, collisions=True).shapes:
            box = corners_of(shape.geometry)
            if box:
                corners.setdefault(shape.body, []).append(moved(shape.body_from_shape, np.array(box)))
        bodies: list[Body] = []
        first = 0
        for model in world.models:
            span = range(first, first + len(model.links))
            first += len(model.links)
            if not model.links:
                continue
            base, base_from_model = _base(model)
            own = {index: np.concatenate(corners[index]) for index in span if index in corners}
            bodies.append(Body(name=model.name, base_index=span[base], base_from_model=base_from_model, corners=own))
        return bodies


class _Shapes:
    """What rays meet."""

    def __init__(self, simulation: Simulation, *, collisions: bool) -> None:
        self._simulation = simulation
        self._collisions = collisions
        self._compiled: CompiledWorld | None = None
        self._renderer: NativeRenderer | None = None
        self._retros = np.zeros(1)

    def cast(self, origin: Vector3, directions: _Array, reach: float, exclude: int) -> Found:
        """Send rays through the world as it is now."""
        compiled = self._simulation.engine.compiled
        if self._renderer is None or self._compiled is not compiled:  # models came or went
            self._compiled = compiled
            scene = scene_of(compiled.world, Diagnostics(), collisions=self._collisions)
            shapes = tuple(_endless(shape) if self._collisions else shape for shape in scene.shapes)
            self._renderer = NativeRenderer(replace(scene, shapes=shapes))
            self._retros = np.array([*(shape.laser_retro for shape in shapes), 0.0])
        self._renderer.update(self._simulation.snapshot().poses)
        distances, met = self._renderer.cast(
            Pose(origin), directions.astype(np.float32), reach_m=reach, exclude=exclude
        )
        return Found(distances.astype(float), self._retros[met])


def _endless(shape: Shape) -> Shape:
    """A plane that is touched has no end."""
    return (
        replace(shape, geometry=Plane(shape.geometry.normal, (0.0, 0.0)))
        if isinstance(shape.geometry, Plane)
        else shape
    )


def _base(model: Model) -> tuple[int, Pose]:
    """The number of the link that the model's frame rides on, and the frame in it."""
    names = [link.name for link in model.links]
    number = names.index(model.canonical_link) if model.canonical_link in names else 0
    return number, model.links[number].model_from_link.inverse()

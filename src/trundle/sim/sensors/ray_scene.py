"""Scene of the sensors other than cameras: ray casters, transmitters and model extents."""

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import EVERY_BIT, Joint, Link, Model, Plane, Transceiver, World
from trundle.sim.render import corners_of, scene_from_world
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Vector3, rotation_from_z, transform_points

from .logical_camera import ModelShapes
from .rays import RayCaster, RayHits, Rays
from .wireless import Transmitter

_Array = NDArray[np.float64]
_FAR = 1e6
"""Half width of an infinite plane's box [m]."""
_HALF_SPACE = [(x, y, z) for x in (-_FAR, _FAR) for y in (-_FAR, _FAR) for z in (-_FAR, 0.0)]


class RayScene:
    """World around one simulation's sensors; ray casters are built on first use."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._collision_caster: RayCaster | None = None
        self._visual_casters: dict[int, RayCaster] = {}
        """Visibility mask → caster."""
        self._models: list[ModelShapes] | None = None
        self._models_world: World | None = None

    def rays(self, origin: Vector3, directions: _Array, reach: float, exclude: int) -> RayHits:
        """Cast against collision shapes; see `Rays`."""
        self._collision_caster = self._updated_caster(self._collision_caster, collisions=True)
        return self._collision_caster.cast(origin, directions, reach, exclude)

    def rays_excluding(self, model: Model, link: Link) -> Rays:
        """Return a caster against the collision shapes that a link may collide with, as Gazebo's sonar is a shape of
        its link. Of the link's own model there are none, or with <self_collide> the shapes of links without a joint
        to the link.
        """
        connected = {link.name, *(end for joint in model.joints for end in _ends(joint, link.name))}

        def may_touch(other: Link) -> bool:
            self_collides = (
                model.self_collide if end.self_collide is None else end.self_collide for end in (link, other)
            )
            return other.name not in connected and any(self_collides)

        names = [other.name for other in model.links if not may_touch(other)]

        def cast(origin: Vector3, directions: _Array, reach: float, exclude: int) -> RayHits:
            del exclude
            self._collision_caster = self._updated_caster(self._collision_caster, collisions=True)
            handle = self._simulation[model.name]
            hidden = [handle.link(name).index for name in names]
            return self._collision_caster.cast_through(origin, directions, reach, hidden)

        return cast

    def visual_rays(self, nearest: float, mask: int) -> Rays:
        """Return a caster against visuals whose flags share a bit with the mask, from the distance `nearest` on [m].

        Gazebo's GPU rays see their own link, too.
        """

        def cast(origin: Vector3, directions: _Array, reach: float, exclude: int) -> RayHits:
            del exclude
            self._visual_casters[mask] = self._updated_caster(
                self._visual_casters.get(mask), collisions=False, mask=mask
            )
            return self._visual_casters[mask].cast_from_distance(origin, directions, reach, nearest)

        return cast

    def _updated_caster(self, caster: RayCaster | None, *, collisions: bool, mask: int = EVERY_BIT) -> RayCaster:
        """Return a caster with current poses; a new one after models were spawned, deleted or edited."""
        simulation = self._simulation
        if caster is None or caster.world is not simulation.world:
            caster = RayCaster(simulation.world, collisions=collisions, mask=mask)
        caster.update(simulation.engine.reader.link_poses(), simulation.animation_state)
        return caster

    def transmitters(self, type_: str) -> list[Transmitter]:
        """Return every sensor of a transmitting type."""
        transmitters: list[Transmitter] = []
        index = 0
        for model in self._simulation.world.models:
            for link in model.links:
                for sensor in link.sensors:
                    if sensor.type == type_:
                        settings = sensor.instrument if isinstance(sensor.instrument, Transceiver) else Transceiver()
                        name = f"{model.name}::{link.name}::{sensor.name}"
                        transmitters.append(
                            Transmitter(
                                name=name,
                                link_index=index,
                                link_from_transmitter=sensor.link_from_sensor,
                                settings=settings,
                            )
                        )
                index += 1
        return transmitters

    @property
    def models(self) -> list[ModelShapes]:
        """All models with the corners of their collision shapes."""
        world = self._simulation.world
        if self._models is None or self._models_world is not world:
            self._models, self._models_world = _model_shapes(world), world
        return self._models


def _ends(joint: Joint, link: str) -> tuple[str, str]:
    """Return the joint's two links if `link` is one of them, else `link` twice."""
    return (joint.parent, joint.child) if link in (joint.parent, joint.child) else (link, link)


def _model_shapes(world: World) -> list[ModelShapes]:
    corners: dict[int, list[_Array]] = {}
    for shape in scene_from_world(world, Diagnostics(), collisions=True).shapes:
        body_from_box = shape.body_from_shape
        if isinstance(shape.geometry, Plane):
            body_from_box, points = body_from_box @ Pose(quaternion=rotation_from_z(shape.geometry.normal)), _HALF_SPACE
        else:
            points = corners_of(shape.geometry)
        if points:
            corners.setdefault(shape.body, []).append(transform_points(body_from_box, np.array(points)))
    bodies: list[ModelShapes] = []
    first = 0
    for model in world.models:
        span = range(first, first + len(model.links))
        first += len(model.links)
        if not model.links:
            continue
        base, base_from_model = _base(model)
        link_corners = {index: np.concatenate(corners[index]) for index in span if index in corners}
        bodies.append(
            ModelShapes(name=model.name, base_index=span[base], base_from_model=base_from_model, corners=link_corners)
        )
    return bodies


def _base(model: Model) -> tuple[int, Pose]:
    """Return the index of the canonical link and the model frame in it."""
    names = [link.name for link in model.links]
    number = names.index(model.canonical_link) if model.canonical_link in names else 0
    return number, model.links[number].model_from_link.inverse()

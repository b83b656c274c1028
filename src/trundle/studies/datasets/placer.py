"""Random poses of models in a picture: on surfaces, without overlaps, at rest."""

import math
from collections.abc import Mapping, Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError
from trundle.sim.physics import SimulationUnstableError
from trundle.sim.render import Scene
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Pose, matrix_from_quaternion

from .instance import Instance
from .outlines import Outlines
from .plan import DatasetPlan, Placement
from .random_stream import POSES, draw_numbers, draw_rotation, random_stream
from .surface import Surface

_Array = NDArray[np.float64]
_ATTEMPTS = 40
_MAX_ARRANGEMENTS = 5
"""Maximum number of arrangements drawn until one comes to rest."""
_CLEARANCE_M = 1e-3
"""Height at which a model is placed above a surface [m]."""
_MAX_OVERLAP_M = 5e-4
"""Penetration up to which models only touch [m]."""
_PARKING_HEIGHT_M = 20_000.0
"""Height of models that a picture does not show [m]; `settle` ends before they reach the ground."""
_PARKING_SPACING_M = 50.0


class Arrangement(Struct, frozen=True, eq=False):
    """Poses of a picture."""

    poses: _Array
    """(links, 7) poses in the world; NaN: absent from the picture."""
    present: tuple[Instance, ...]
    world_from_models: Mapping[int, Pose]
    """Number of an instance → pose of its model."""


class Placer:
    """Random arrangements of one world."""

    def __init__(
        self, plan: DatasetPlan, simulation: Simulation, instances: Sequence[Instance], scene: Scene, outlines: Outlines
    ) -> None:
        """Find the surfaces, and park the models to place.

        Raises:
            DescriptionError: unknown model, or a model that cannot be moved.
        """
        self._plan = plan
        self._simulation = simulation
        self._instances = instances
        self._outlines = outlines
        self._models = {
            instance.number: find_model(simulation, instance.model, instance.placement) for instance in instances
        }
        self._groups: dict[str, list[Instance]] = {}
        """Object, or "" for distractors → its instances."""
        for instance in instances:
            self._groups.setdefault(instance.plan.name if instance.plan else "", []).append(instance)
        self._extents: dict[int, _Array] = {}
        rest = simulation.snapshot().poses
        self._surfaces = self._find_surfaces(scene, rest)
        for instance in instances:
            self._check_joints(instance)
            if self._moves(instance):
                self._park(instance)
        self._saved = simulation.save()

    def _find_surfaces(self, scene: Scene, poses: _Array) -> dict[str, Surface]:
        surfaces: dict[str, Surface] = {}
        moved = {instance.model for instance in self._instances if self._moves(instance)}
        for instance in self._instances:
            name = instance.placement.surface
            if name is None or name in surfaces:
                continue
            at = instance.placement.at
            if name in moved:
                raise DescriptionError(at, f"surface: {name!r} is placed itself; name a model that stays where it is")
            model = find_model(self._simulation, name, instance.placement)
            surfaces[name] = Surface(scene, bodies_of(model), poses, self._outlines, at)
            if surfaces[name].extent is None and instance.placement.within is None:
                raise DescriptionError(
                    at, f"surface: {name!r} is an endless plane; add within: {{x: [low, high], y: […]}}"
                )
        return surfaces

    def _moves(self, instance: Instance) -> bool:
        """True if the plan draws the instance's pose."""
        return instance.placement.surface is not None or instance.placement.position is not None

    def _check_joints(self, instance: Instance) -> None:
        plan, model = instance.plan, self._models[instance.number]
        if self._moves(instance) and not any(
            self._simulation.engine.writer.is_free(link.index) for link in model.links
        ):
            message = f"model {model.name!r} is static or fixed to the world, and cannot be placed"
            raise DescriptionError(instance.placement.at, message)
        if plan is not None and plan.joints != "any":
            for name in plan.joints:
                names = [joint.name for joint in model.joints if len(joint.axes) == 1]
                if name not in names:
                    message = f"model {model.name!r} has no joint {name!r}; joints: {', '.join(names) or 'none'}"
                    raise DescriptionError(plan.at, message)

    def _park(self, instance: Instance) -> None:
        self._models[instance.number].set_pose(Pose((_PARKING_SPACING_M * instance.number, 0.0, _PARKING_HEIGHT_M)))

    def arrange(self, number: int) -> Arrangement:
        """Draw the arrangement of a picture.

        Raises:
            SimulationUnstableError: the placed models do not come to rest.
        """
        random = random_stream(self._plan.seed, number, POSES)
        placed = self._settle(random, attempts=_MAX_ARRANGEMENTS)
        poses = self._simulation.snapshot().poses.copy()
        present = {instance.number for instance in placed}
        for instance in self._instances:
            if instance.number not in present:
                poses[list(bodies_of(self._models[instance.number]))] = np.nan
        return Arrangement(
            poses=poses,
            present=tuple(placed),
            world_from_models={instance.number: self._models[instance.number].pose for instance in placed},
        )

    def _settle(self, random: np.random.Generator, *, attempts: int) -> list[Instance]:
        """Place instances, let them fall, and return those that found a free place."""
        self._simulation.restore(self._saved)
        present = [instance for group in self._groups.values() for instance in self._chosen(group, random)]
        placed = [instance for instance in present if self._place(instance, random)]
        try:
            self._simulation.run(self._plan.settle_s)
        except SimulationUnstableError:
            if attempts == 1:
                raise
            return self._settle(random, attempts=attempts - 1)
        return placed

    def _chosen(self, group: list[Instance], random: np.random.Generator) -> list[Instance]:
        plan = group[0].plan
        if plan is not None:
            return group[: plan.count.draw_whole(random)] if plan.model is not None else group
        assert self._plan.distractors is not None
        count = self._plan.distractors.count.draw_whole(random)
        return [group[i] for i in sorted(random.choice(len(group), size=count, replace=False).tolist())]

    def _place(self, instance: Instance, random: np.random.Generator) -> bool:
        """Pose an instance; False if no free place was found."""
        model = self._models[instance.number]
        self._set_joints(instance, model, random)
        if not self._moves(instance):
            return True
        points = self._points(instance, model)
        for _ in range(_ATTEMPTS):
            pose = self._draw_pose(instance.placement, points, random)
            if pose is None:
                continue
            model.set_pose(pose)
            if not self._plan.apart or not self._overlaps(model.name):
                return True
        self._park(instance)
        return False

    def _points(self, instance: Instance, model: ModelHandle) -> _Array:
        """Return the (N, 3) extent of a parked model in its own frame, upright [m]; cached unless its joints vary."""
        points = self._extents.get(instance.number)
        if points is None:
            points = self._outlines.in_world(bodies_of(model), self._simulation.snapshot().poses)
            points = points - model.pose.position
            if instance.plan is None or not instance.plan.joints:
                self._extents[instance.number] = points
        return points

    def _set_joints(self, instance: Instance, model: ModelHandle, random: np.random.Generator) -> None:
        plan = instance.plan
        if plan is None:
            return
        if plan.joints == "any":
            for joint in model.joints:
                if len(joint.axes) == 1 and joint.is_driven and joint.joint.axis is not None:
                    low, high = max(joint.joint.axis.lower, -math.pi), min(joint.joint.axis.upper, math.pi)
                    joint.set_position(float(random.uniform(low, high)))
        else:
            for name, quantity in plan.joints.items():
                model.joint(name).set_position(quantity.draw(random))

    def _draw_pose(self, placement: Placement, points: _Array, random: np.random.Generator) -> Pose | None:
        """Draw a pose; None if the surface does not support the model there.

        Args:
            placement: placement on a surface or at a position.
            points: (N, 3) extent of the model in its own frame, upright [m].
            random: random stream of the picture.
        """
        rotation = draw_rotation(placement.rotation, random)
        if placement.position is not None:
            return Pose(draw_numbers(placement.position, random), rotation)
        assert placement.surface is not None
        surface = self._surfaces[placement.surface]
        corners = placement.within or surface.extent
        assert corners is not None
        (x0, y0), (x1, y1) = corners
        x, y = float(random.uniform(x0, x1)), float(random.uniform(y0, y1))
        turned = matrix_from_quaternion(rotation) @ points.T if len(points) else np.zeros((3, 1))
        (left, back, lowest), (right, front, _) = turned.min(axis=1).tolist(), turned.max(axis=1).tolist()
        foot = np.array([(0.0, 0.0), (left, back), (left, front), (right, back), (right, front)])
        height = surface.height(np.add(foot, (x, y)))
        return None if height is None else Pose((x, y, height - lowest + _CLEARANCE_M), rotation)

    def _overlaps(self, name: str) -> bool:
        """True if a model penetrates another one."""
        for one, other in self._simulation.engine.overlaps(_MAX_OVERLAP_M):
            models = one.partition("::")[0], other.partition("::")[0]
            if name in models and models[0] != models[1]:
                return True
        return False


def bodies_of(model: ModelHandle) -> range:
    """Return the indices of a model's links."""
    return range(model.links[0].index, model.links[0].index + len(model.links)) if model.links else range(0)


def find_model(simulation: Simulation, name: str, placement: Placement) -> ModelHandle:
    """Return a model.

    Raises:
        DescriptionError: no such model; the message lists the models.
    """
    for model in simulation.models:
        if model.name == name:
            return model
    names = ", ".join(repr(model.name) for model in simulation.models) or "none"
    raise DescriptionError(placement.at, f"the world has no model {name!r}; models: {names}")

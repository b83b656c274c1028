"""Places of models in a picture: on surfaces, apart from each other, at rest."""

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
from .random_stream import PLACES, draw_numbers, draw_rotation, random_stream
from .surface import Surface

_Array = NDArray[np.float64]
_ATTEMPTS = 40
_SETTLINGS = 5
"""Arrangements drawn until physics lets one come to rest."""
_CLEARANCE_M = 1e-3
"""Height above a surface."""
_DEEPEST_M = 5e-4
"""Penetration that counts as touching."""
_FAR_M = 20_000.0
"""Height at which models wait that a picture does not show; `settle` ends before they have fallen."""
_APART_M = 50.0


class Arrangement(Struct, frozen=True, eq=False):
    """Poses of a picture."""

    poses: _Array
    """(links, 7) in the world; NaN: not in the picture."""
    present: tuple[Instance, ...]
    world_from_models: Mapping[int, Pose]
    """Number of an instance → pose of its model."""


class Placer:
    """Draws arrangements of one world."""

    def __init__(
        self, plan: DatasetPlan, simulation: Simulation, instances: Sequence[Instance], scene: Scene, outlines: Outlines
    ) -> None:
        """Park what is placed, and find the surfaces.

        Raises:
            DescriptionError: a model that the plan names is not there, or cannot be moved; with its line in the plan.
        """
        self._plan = plan
        self._simulation = simulation
        self._instances = instances
        self._outlines = outlines
        self._models = {each.number: find_model(simulation, each.model, each.placement) for each in instances}
        self._groups: dict[str, list[Instance]] = {}
        """Object, or "" for distractors → its instances."""
        for each in instances:
            self._groups.setdefault(each.plan.name if each.plan else "", []).append(each)
        self._extents: dict[int, _Array] = {}
        rest = simulation.snapshot().poses
        self._surfaces = self._find_surfaces(scene, rest)
        for each in instances:
            self._check_joints(each)
            if self._moves(each):
                self._park(each)
        self._saved = simulation.save()

    def _find_surfaces(self, scene: Scene, poses: _Array) -> dict[str, Surface]:
        surfaces: dict[str, Surface] = {}
        moved = {each.model for each in self._instances if self._moves(each)}
        for each in self._instances:
            name = each.placement.surface
            if name is None or name in surfaces:
                continue
            at = each.placement.at
            if name in moved:
                raise DescriptionError(at, f"surface: {name!r} is placed itself; name a model that stays where it is")
            model = find_model(self._simulation, name, each.placement)
            surfaces[name] = Surface(scene, bodies_of(model), poses, self._outlines, at)
            if surfaces[name].extent is None and each.placement.within is None:
                raise DescriptionError(
                    at, f"surface: {name!r} is an endless plane; add within: {{x: [low, high], y: […]}}"
                )
        return surfaces

    def _moves(self, instance: Instance) -> bool:
        """True if the plan draws its pose."""
        return instance.placement.surface is not None or instance.placement.position is not None

    def _check_joints(self, instance: Instance) -> None:
        plan, model = instance.plan, self._models[instance.number]
        if self._moves(instance) and not any(
            self._simulation.engine.writer.is_free(link.index) for link in model.links
        ):
            what = f"model {model.name!r} is static or fixed to the world, and cannot be placed"
            raise DescriptionError(instance.placement.at, what)
        if plan is not None and plan.joints != "any":
            for name in plan.joints:
                there = [joint.name for joint in model.joints if len(joint.axes) == 1]
                if name not in there:
                    what = f"model {model.name!r} has no joint {name!r}; joints: {', '.join(there) or 'none'}"
                    raise DescriptionError(plan.at, what)

    def _park(self, instance: Instance) -> None:
        self._models[instance.number].set_pose(Pose((_APART_M * instance.number, 0.0, _FAR_M)))

    def arrange(self, number: int) -> Arrangement:
        """Draw the arrangement of a picture.

        Raises:
            SimulationUnstableError: physics does not let the things come to rest.
        """
        random = random_stream(self._plan.seed, number, PLACES)
        placed = self._settle(random, attempts=_SETTLINGS)
        poses = self._simulation.snapshot().poses.copy()
        there = {each.number for each in placed}
        for each in self._instances:
            if each.number not in there:
                poses[list(bodies_of(self._models[each.number]))] = np.nan
        return Arrangement(
            poses=poses,
            present=tuple(placed),
            world_from_models={each.number: self._models[each.number].pose for each in placed},
        )

    def _settle(self, random: np.random.Generator, *, attempts: int) -> list[Instance]:
        """Place instances, let them fall, and return those that found a place."""
        self._simulation.restore(self._saved)
        present = [each for group in self._groups.values() for each in self._chosen(group, random)]
        placed = [each for each in present if self._place(each, random)]
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
        """Return (N, 3) extent of a parked model in its own frame, upright [m]; kept unless its joints move."""
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
        """Draw a pose; None if it stands on nothing there.

        Args:
            placement: on a surface or at a position.
            points: (N, 3) extent of the model in its own frame, upright [m].
            random: the picture's.
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
        for one, other in self._simulation.engine.overlaps(_DEEPEST_M):
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
        DescriptionError: there is none; lists those that there are.
    """
    for model in simulation.models:
        if model.name == name:
            return model
    there = ", ".join(repr(model.name) for model in simulation.models) or "none"
    raise DescriptionError(placement.at, f"the world has no model {name!r}; models: {there}")

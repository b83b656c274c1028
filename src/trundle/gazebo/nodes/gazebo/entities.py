"""Lookup of models, links and joints by /gazebo's names: `model`, `model::link`, or `link`: its first match."""

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Light, World
from trundle.sim.simulation import JointHandle, LinkHandle, ModelHandle, Simulation
from trundle.spatial import Pose

_WORLD = frozenset({"", "world", "map", "/map"})


def find_link(simulation: Simulation, name: str) -> LinkHandle:
    """Find a link by scoped name, or the first one by plain name.

    Raises:
        UsageError: no such name; the message lists existing names.
    """
    for model in simulation.models:
        for link in model.links:
            if _matches(name, model.name, link.name):
                return link
    raise UsageError(f"no link {name!r}; links: {_name_list([n for n, _ in scoped_links(simulation)])}")


def find_joint(simulation: Simulation, name: str) -> JointHandle:
    """Find a joint by plain or scoped name.

    Raises:
        UsageError: no such name; the message lists existing names.
    """
    for model in simulation.models:
        for joint in model.joints:
            if _matches(name, model.name, joint.name):
                return joint
    names = [joint.name for model in simulation.models for joint in model.joints]
    raise UsageError(f"no joint {name!r}; joints: {_name_list(names)}")


def find_light(world: World, name: str) -> Light:
    """Find a light by name.

    Raises:
        UsageError: no such name; the message lists existing names.
    """
    for light in world.lights:
        if light.name == name:
            return light
    raise UsageError(f"no light {name!r}; lights: {_name_list([light.name for light in world.lights])}")


def scoped_links(simulation: Simulation) -> list[tuple[str, LinkHandle]]:
    """Return all links with their scoped names, in file order."""
    return [(f"{model.name}::{link.name}", link) for model in simulation.models for link in model.links]


def find_model(simulation: Simulation, name: str) -> ModelHandle:
    """Find a model by name.

    Raises:
        UsageError: no such name; the message lists existing names.
    """
    return simulation[name]


def world_from_entity(simulation: Simulation, entity: str) -> Pose:
    """Return the pose of a model, a link or the world, in the world.

    Raises:
        UsageError: no such entity.
    """
    if is_world(entity):
        return Pose()
    if any(model.name == entity for model in simulation.models):
        return simulation[entity].pose
    return find_link(simulation, entity).pose


def is_world(entity: str) -> bool:
    """Return True for names of the world."""
    return entity in _WORLD


def _matches(name: str, model: str, part: str) -> bool:
    """Return True if a scoped or plain name matches a model's part; names of parts of nested models are scoped."""
    return name in (f"{model}::{part}", part, part.rpartition("::")[2])


def _name_list(names: list[str]) -> str:
    return ", ".join(names[:40]) or "none"

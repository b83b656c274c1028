"""Models, links and joints by the names that /gazebo uses: `model`, `model::link`, `link` where it is the first one."""

from trundle.diagnostics import UsageError
from trundle.model import Light, World
from trundle.simulation import JointHandle, LinkHandle, ModelHandle, Simulation
from trundle.spatial import Pose

_WORLD = frozenset({"", "world", "map", "/map"})


def find_link(simulation: Simulation, name: str) -> LinkHandle:
    """The link of a scoped name, or the first link of a plain one.

    Raises:
        UsageError: with the names there are.
    """
    for model in simulation.models:
        for link in model.links:
            if _is_called(name, model.name, link.name):
                return link
    raise UsageError(f"no link {name!r}; there are: {_listed([n for n, _ in scoped_links(simulation)])}")


def find_joint(simulation: Simulation, name: str) -> JointHandle:
    """The joint of a name, which may be scoped.

    Raises:
        UsageError: with the names there are.
    """
    for model in simulation.models:
        for joint in model.joints:
            if _is_called(name, model.name, joint.name):
                return joint
    names = [joint.name for model in simulation.models for joint in model.joints]
    raise UsageError(f"no joint {name!r}; there are: {_listed(names)}")


def find_light(world: World, name: str) -> Light:
    """The light of a name.

    Raises:
        UsageError: with the names there are.
    """
    for light in world.lights:
        if light.name == name:
            return light
    raise UsageError(f"no light {name!r}; there are: {_listed([light.name for light in world.lights])}")


def scoped_links(simulation: Simulation) -> list[tuple[str, LinkHandle]]:
    """Every link with its scoped name, in file order."""
    return [(f"{model.name}::{link.name}", link) for model in simulation.models for link in model.links]


def find_model(simulation: Simulation, name: str) -> ModelHandle:
    """The model of a name.

    Raises:
        UsageError: with the names there are.
    """
    return simulation[name]


def world_from_entity(simulation: Simulation, entity: str) -> Pose:
    """Where an entity is: a model, a link, or the world by any of its names.

    Raises:
        UsageError: there is no such entity.
    """
    if is_world(entity):
        return Pose()
    if any(model.name == entity for model in simulation.models):
        return simulation[entity].pose
    return find_link(simulation, entity).pose


def is_world(entity: str) -> bool:
    """Whether it is one of the world's names."""
    return entity in _WORLD


def _is_called(name: str, model: str, part: str) -> bool:
    """Whether a name, scoped or plain, means a part of a model; those of models within it are scoped themselves."""
    return name in (f"{model}::{part}", part, part.rpartition("::")[2])


def _listed(names: list[str]) -> str:
    return ", ".join(names[:40]) or "none"

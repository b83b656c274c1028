"""Models, simple shapes and lights that a user of the page inserts into the running world."""

import itertools
from collections.abc import Collection
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.base.xmlnode import read_xml
from trundle.page import InsertAction, InsertLight, InsertModel, ListModels
from trundle.robots.description import load, load_text
from trundle.robots.model import Light, Model, flattened
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot
from trundle.spatial import Pose

from ..requests.answers import Answer, CodeQuestion, Inserted, ModelEntry, ModelList
from ..shown_world import ShownWorld
from .code_consent import CodeConsent
from .model_edits import add_light

_SHAPES = {
    "box": ("<box><size>1 1 1</size></box>", 1 / 6, 1 / 6),
    "sphere": ("<sphere><radius>0.5</radius></sphere>", 0.1, 0.1),
    "cylinder": ("<cylinder><radius>0.5</radius><length>1</length></cylinder>", 7 / 48, 1 / 8),
}
"""Geometry, and moments of inertia across and along z of 1 kg [kg·m²]; each is 1 m high, as Gazebo's."""
_HALF_M = 0.5
_LIGHT_HEIGHT_M = {"point": 2.0, "spot": 2.0, "directional": 5.0}
_LIGHT_ANGLES = {"spot": {"inner_angle_rad": 0.6, "outer_angle_rad": 1.0, "falloff": 1.0}}


class Insertion:
    """Executes requests to insert into one world."""

    def __init__(self, world: ShownWorld, consent: CodeConsent) -> None:
        """Create it; `consent` asks the user before code is run."""
        self._world, self._consent = world, consent
        self._simulation, self._packages = world.simulation, world.packages

    def handle(self, action: InsertAction) -> Answer:
        """Execute a request.

        Raises:
            TrundleError: the request cannot be executed.
        """
        match action:
            case ListModels():
                return ModelList(models=list_models(self._packages))
            case InsertModel():
                return self._insert_model(action)
            case InsertLight():
                return self._insert_light(action)

    def _insert_model(self, action: InsertModel) -> Inserted | CodeQuestion:
        model, robot = self._shape(action.model) if action.is_shape else self._read(action.model)
        if (question := self._consent.question(model, action.consent)) is not None:
            return question
        name = free_name(model.name, {other.name for other in self._simulation.models})
        pose = Pose(action.position) @ model.world_from_model
        self._world.spawn(replace(model, name=name, world_from_model=pose), robot)
        return Inserted(name=name)

    def _read(self, name: str) -> tuple[Model, Robot | None]:
        """Read a model from the model path."""
        if name not in self._packages.models():
            raise UsageError(f"no model {name!r} on the model path")
        loaded = load(f"model://{name}", self._simulation.report, packages=self._packages)
        models = flattened(loaded.world).models
        if len(models) != 1:
            raise UsageError(f"model {name!r}: its file has {len(models)} models; only a file with one can be inserted")
        return models[0], loaded.robot

    def _shape(self, kind: str) -> tuple[Model, None]:
        if kind not in _SHAPES:
            raise UsageError(f"no shape {kind!r}; there are: {', '.join(_SHAPES)}")
        loaded = load_text(
            shape_sdf(kind), name=f"<{kind}>", folder=Path.cwd(), packages=self._packages, report=Diagnostics()
        )
        return loaded.world.models[0], None

    def _insert_light(self, action: InsertLight) -> Inserted:
        world = self._simulation.world
        x, y, z = action.position
        light = Light(
            name=free_name(f"{action.type}_light", {light.name for light in world.lights}),
            type=action.type,
            at=world.at,
            world_from_light=Pose((x, y, z + _LIGHT_HEIGHT_M[action.type])),
            range_m=20.0,
            constant=0.5,
            linear=0.01,
            quadratic=0.001,
            cast_shadows=action.type == "directional",
        )
        lit = replace(light, **_LIGHT_ANGLES.get(action.type, {}))
        add_light(lit, self._world)
        return Inserted(name=light.name)


def list_models(packages: Packages) -> tuple[ModelEntry, ...]:
    """Return every model that can be inserted, uploaded ones first, then by title."""
    models = (
        _entry(name, folder, uploaded=folder.parent in packages.added_models)
        for name, folder in packages.models().items()
    )
    return tuple(sorted(models, key=lambda entry: (not entry.uploaded, entry.title.lower(), entry.name)))


def _entry(name: str, folder: Path, *, uploaded: bool) -> ModelEntry:
    """Return a model's entry, with title and description from its model.config."""
    try:
        root = read_xml(folder / "model.config", report=Diagnostics())
    except TrundleError:
        return ModelEntry(name=name, title=folder.name, description="", uploaded=uploaded)
    title, description = root.string("name"), " ".join(root.string("description").split())
    return ModelEntry(name=name, title=(title or folder.name)[:100], description=description[:300], uploaded=uploaded)


def shape_sdf(kind: str) -> str:
    """Return the SDF of a simple shape of 1 kg."""
    geometry, across, along = _SHAPES[kind]
    inertia = f"<ixx>{across}</ixx><iyy>{across}</iyy><izz>{along}</izz>"
    shape = f"<geometry>{geometry}</geometry>"
    grey = "<material><ambient>0.3 0.3 0.3 1</ambient><diffuse>0.7 0.7 0.7 1</diffuse></material>"
    return (
        f'<sdf version="1.6"><model name="{kind}"><pose>0 0 {_HALF_M} 0 0 0</pose><link name="link">'
        f"<inertial><mass>1</mass><inertia>{inertia}</inertia></inertial>"
        f'<collision name="collision">{shape}</collision><visual name="visual">{shape}{grey}</visual>'
        "</link></model></sdf>"
    )


def free_name(name: str, used: Collection[str]) -> str:
    """Return an unused name: `name`, `name_0`, …"""
    numbered = (f"{name}_{number}" for number in itertools.count())
    return next(candidate for candidate in itertools.chain((name,), numbered) if candidate not in used)

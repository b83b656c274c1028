"""GLB files of a simulated world: one per model, written again only when its appearance changes."""

from collections.abc import Callable

from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Light, Model, Road, Visual, World
from trundle.sim.gltf import Document, add_scene, content_name
from trundle.sim.render import DEFAULT_LIGHTS, Scene, report_unreadable_textures, scene_from_world
from trundle.spatial import Pose, rows_from_poses

from ..world.draft_info import FileUrl

_FOLDER = "world/"
BodyOf = Callable[[str], int]
"""Returns the body number of `model::link`."""


class _File(Struct, frozen=True, kw_only=True):
    """A GLB file, without its content."""

    url: str
    resources: frozenset[str]
    """URLs of the meshes and images that it refers to."""


class _Appearance(Struct, frozen=True, kw_only=True):
    """Everything that a model's file depends on."""

    links: tuple[tuple[str, int, tuple[Visual, ...], tuple[Light, ...]], ...]
    """Name, body number, visuals and lights of each link."""
    roads: tuple[Road, ...]
    shadows: bool


class NamedFiles(Struct, frozen=True, kw_only=True):
    """Entries of a manifest."""

    files: tuple[FileUrl, ...]
    collisions: str
    resources: tuple[str, ...]


class WorldFiles:
    """Files of the world of the latest `update`."""

    def __init__(self) -> None:
        self._models: dict[str, tuple[_Appearance, _File]] = {}
        self._served: frozenset[str] = frozenset()

    def update(self, world: World, body_of: BodyOf, report: Diagnostics) -> tuple[NamedFiles, dict[str, bytes]]:
        """Write the files of a world that changed.

        Args:
            world: flat world.
            body_of: body numbers of the links.
            report: receives warnings about shapes that cannot be drawn.

        Returns:
            Entries for the manifest, and URL → content of new files.
        """
        contents: dict[str, bytes] = {}
        models: dict[str, tuple[_Appearance, _File]] = {}
        roads = _owner_of_roads(world)
        for model in world.models:
            looks = _appearance(model, world, body_of, with_roads=model is roads)
            before = self._models.get(model.name)
            if before is not None and before[0] == looks:
                models[model.name] = before
                continue
            alone = replace(world, models=(model,), lights=(), roads=looks.roads)
            models[model.name] = (looks, self._write(alone, body_of, contents, report))
        self._models = models
        lights = self._write_lights(world, contents)
        collisions = self._write(world, body_of, contents, report, collisions=True)
        of_models = (FileUrl(id=name, url=file.url) for name, (_, file) in models.items())
        files = (FileUrl(id="", url=lights.url), *of_models)
        written = [lights, collisions, *(file for _, file in models.values())]
        resources = frozenset().union(*(file.resources for file in written))
        named = resources | {file.url for file in written}
        new = {url: content for url, content in contents.items() if url not in self._served}
        self._served = named
        return NamedFiles(files=files, collisions=collisions.url, resources=tuple(sorted(resources))), new

    def _write_lights(self, world: World, contents: dict[str, bytes]) -> _File:
        """Write the lights of the world itself; without any light, the default lights of cameras."""
        alone = scene_from_world(replace(world, models=(), roads=()), Diagnostics())
        is_dark = not alone.lights and not any(link.lights for model in world.models for link in model.links)
        return self._serve(replace(alone, lights=DEFAULT_LIGHTS) if is_dark else alone, [], [], contents)

    def _write(
        self,
        world: World,
        body_of: BodyOf,
        contents: dict[str, bytes],
        report: Diagnostics,
        *,
        collisions: bool = False,
    ) -> _File:
        scene = scene_from_world(world, report, collisions=collisions)
        if collisions:
            scene = replace(scene, lights=())
        report_unreadable_textures(scene, report)
        poses = [model.world_from_model @ link.model_from_link for model in world.models for link in model.links]
        return self._serve(scene, poses, [body_of(name) for name in (*scene.bodies, *scene.bones)], contents)

    def _serve(self, scene: Scene, poses: list[Pose], bodies: list[int], contents: dict[str, bytes]) -> _File:
        document = Document(embed=False)
        root = add_scene(document, scene, rows_from_poses(poses), bodies)
        glb = document.glb(root)
        url = f"{_FOLDER}{content_name(glb)}.glb"
        contents |= {url: glb, **{_FOLDER + name: content for name, content in document.files.items()}}
        return _File(url=url, resources=frozenset(_FOLDER + name for name in document.files))


def _appearance(model: Model, world: World, body_of: BodyOf, *, with_roads: bool) -> _Appearance:
    return _Appearance(
        links=tuple(
            (link.name, body_of(f"{model.name}::{link.name}"), link.visuals, link.lights) for link in model.links
        ),
        roads=world.roads if with_roads else (),
        shadows=world.scene.shadows,
    )


def _owner_of_roads(world: World) -> Model | None:
    """Return the model whose first static link carries the roads; None if there is none."""
    static = (model for model in world.models if model.links and (model.static or any(k.fixed for k in model.links)))
    return next(static, None)

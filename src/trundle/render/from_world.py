"""A world's visuals, or its collision shapes, as a scene."""

from collections.abc import Iterator

from trundle.diagnostics import Diagnostics, Source
from trundle.meshes import Mesh, MeshError, load_mesh
from trundle.model import (
    GREY,
    Collision,
    Cone,
    Empty,
    Geometry,
    Heightmap,
    MeshFile,
    Polyline,
    Rgba,
    Visual,
    World,
)

from .scene import Scene, SceneLight, Shape, ShapeGeometry

_COLLISION: Rgba = (1.0, 0.55, 0.1, 0.45)
_BARELY_THERE = 0.02
"""Opacity below which a visual is not drawn at all."""


def scene_of(world: World, report: Diagnostics, *, collisions: bool = False) -> Scene:
    """Make a scene whose bodies are the links of all models, in file order: that of `Snapshot.poses`."""
    shapes: list[Shape] = []
    bodies: list[str] = []
    for model in world.models:
        for link in model.links:
            items = link.collisions if collisions else link.visuals
            shapes += _shapes(items, len(bodies), report)
            bodies.append(f"{model.name}::{link.name}")
    lights = tuple(
        SceneLight(direction=light.world_from_light.direction(light.direction), diffuse=light.diffuse)
        for light in world.lights
        if light.type == "directional"
    )
    for light in world.lights:
        if light.type != "directional" and not collisions:
            report.warn(
                light.at, f"light {light.name!r}: {light.type} lights are not drawn yet; only directional ones are"
            )
    return Scene(bodies=tuple(bodies), shapes=tuple(shapes), lights=lights, background=world.scene.background)


def _shapes(items: tuple[Visual, ...] | tuple[Collision, ...], body: int, report: Diagnostics) -> Iterator[Shape]:
    for item in items:
        geometry = _geometry(item.geometry, item.at, report)
        if geometry is None:
            continue
        if isinstance(item, Collision):
            yield Shape(
                name=item.name, body=body, geometry=geometry, body_from_shape=item.link_from_collision, rgba=_COLLISION
            )
            continue
        for piece, (r, g, b, a) in _painted(geometry, item):
            rgba = (r, g, b, a * (1.0 - item.transparency))
            if rgba[3] > _BARELY_THERE:
                yield Shape(name=item.name, body=body, geometry=piece, body_from_shape=item.link_from_visual, rgba=rgba)


def _painted(geometry: ShapeGeometry, visual: Visual) -> Iterator[tuple[ShapeGeometry, Rgba]]:
    """A shape with its colour; a mesh that the description does not paint comes in the colours of its file."""
    if isinstance(geometry, Mesh) and visual.material is GREY:
        for piece in geometry.by_look():
            yield piece, piece.rgba or visual.material.diffuse
    else:
        yield geometry, visual.material.diffuse


def _geometry(geometry: Geometry, at: Source, report: Diagnostics) -> ShapeGeometry | None:
    match geometry:
        case MeshFile(path=None) | Empty():
            return None
        case Cone() | Polyline() | Heightmap():
            report.warn(at, f"a {type(geometry).__name__.lower()} is not drawn yet; it is left out")
            return None
        case MeshFile(path=path):
            assert path is not None  # caught above
        case _:
            return geometry
    try:
        mesh = load_mesh(path, submesh=geometry.submesh, center=geometry.center_submesh)
    except MeshError as error:
        report.warn(at, f"{error}; the shape is left out")
        return None
    for name in sorted({part.lost_texture for part in mesh.parts if part.lost_texture is not None}):
        report.info(
            Source(str(path)), f"its texture {name!r} is nowhere in the model's folder; a plain colour is drawn"
        )
    return mesh.scaled(geometry.scale)

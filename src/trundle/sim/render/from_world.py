"""Conversion of a world's visuals or collisions to a scene."""

from collections.abc import Iterator

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots import meshes
from trundle.robots.meshes import Mesh, MeshError, cone_mesh, prism_mesh
from trundle.robots.model import (
    EVERY_BIT,
    GREY,
    Collision,
    Cone,
    Empty,
    Geometry,
    Heightmap,
    Light,
    MeshFile,
    Polyline,
    Rgba,
    Visual,
    World,
)

from .material_shape import material_shape
from .scene import Scene, SceneLight, SceneSkin, Shape, ShapeGeometry

_COLLISION: Rgba = (1.0, 0.55, 0.1, 0.45)
_SKY: tuple[Rgba, Rgba] = ((0.86, 0.91, 0.96, 1.0), (0.30, 0.52, 0.82, 1.0))
_MAX_CORNERS = 1000
"""Maximum number of corners of a polyline; the time of triangulation grows with its cube."""
_MIN_OPACITY = 0.02
"""Opacity below which a visual is not drawn."""


def scene_from_world(world: World, report: Diagnostics, *, collisions: bool = False, mask: int = EVERY_BIT) -> Scene:
    """Return a scene whose bodies are the links of all models, in the order of `Snapshot.poses`.

    Args:
        world: world with its models.
        report: receives warnings of shapes that cannot be drawn.
        collisions: draw collisions instead of visuals.
        mask: visibility mask; only visuals whose flags share a bit with it are drawn.
    """
    shapes: list[Shape] = []
    bodies: list[str] = []
    lights = [_light(light, None, world) for light in world.lights]
    actors = {} if collisions else {f"{actor.name}_pose": actor for actor in world.actors}
    skins: list[SceneSkin] = []
    for model in world.models:
        for link in model.links:
            visible = tuple(visual for visual in link.visuals if visual.visibility_flags & mask)
            items = link.collisions if collisions else visible
            actor = actors.get(link.name)
            animated = None
            if actor is not None and actor.name == model.name:
                from .actor_skins import skinned_shapes  # this module reads COLLADA's bones; few worlds have any

                animated = skinned_shapes(actor, len(bodies), len(shapes))
            if animated is None:
                shapes += _shapes(items, len(bodies), report)
            else:
                shapes += animated[0]
                skins.append(animated[1])
            lights += [_light(light, len(bodies), world) for light in link.lights]
            bodies.append(f"{model.name}::{link.name}")
    if world.roads and not collisions:
        from .roads import road_shapes

        shapes += road_shapes(world, report)
    return Scene(
        bodies=tuple(bodies),
        shapes=tuple(shapes),
        skins=tuple(skins),
        lights=tuple(lights),
        ambient=world.scene.ambient,
        background=world.scene.background,
        sky=_SKY if world.scene.sky else None,
        fog=world.scene.fog,
    )


def _light(light: Light, body: int | None, world: World) -> SceneLight:
    def dimmed(color: Rgba) -> Rgba:
        return (color[0] * light.intensity, color[1] * light.intensity, color[2] * light.intensity, color[3])

    return SceneLight(
        name=light.name,
        kind=light.type,
        body=body,
        position=light.world_from_light.position,
        direction=light.world_from_light.transform_vector(light.direction),
        diffuse=dimmed(light.diffuse),
        specular=dimmed(light.specular),
        attenuation=(1.0, 0.0, 0.0) if light.type == "directional" else (light.constant, light.linear, light.quadratic),
        range_m=light.range_m,
        inner_angle_rad=light.inner_angle_rad,
        outer_angle_rad=light.outer_angle_rad,
        falloff=light.falloff,
        casts_shadows=light.cast_shadows and world.scene.shadows,
    )


def _shapes(items: tuple[Visual, ...] | tuple[Collision, ...], body: int, report: Diagnostics) -> Iterator[Shape]:
    for item in items:
        geometry = _geometry(item.geometry, item.at, report)
        if geometry is None:
            continue
        if isinstance(item, Collision):
            yield Shape(
                name=item.name,
                body=body,
                geometry=geometry,
                body_from_shape=item.link_from_collision,
                rgba=_COLLISION,
                laser_retro=item.laser_retro,
            )
            continue
        for shape in _textured_shapes(geometry, item, body):
            r, g, b, a = shape.rgba
            if (opacity := a * (1.0 - item.transparency)) > _MIN_OPACITY:
                yield replace(shape, rgba=(r, g, b, opacity))


def _textured_shapes(geometry: ShapeGeometry, visual: Visual, body: int) -> Iterator[Shape]:
    """Yield a shape with its material; a mesh without one has the colors of its file."""
    material = visual.material
    shape = material_shape(visual.name, body, geometry, material)
    shape = replace(
        shape,
        body_from_shape=visual.link_from_visual,
        casts_shadow=visual.cast_shadows,
        laser_retro=visual.laser_retro,
    )
    if not (isinstance(geometry, Mesh) and material is GREY):
        yield shape
        return
    for piece in geometry.split_by_material():
        texture = piece.parts[0].texture if piece.parts and piece.uv is not None else None
        rgba = piece.parts[0].tint if texture is not None else piece.rgba
        yield replace(
            shape, geometry=piece, rgba=rgba or material.diffuse, ambient=rgba or material.ambient, texture=texture
        )


def _prism(
    outlines: tuple[tuple[tuple[float, float], ...], ...], height: float, at: Source, report: Diagnostics
) -> Mesh | None:
    if sum(map(len, outlines)) > _MAX_CORNERS:
        report.warn(at, f"a polyline of more than {_MAX_CORNERS} corners; it is not drawn", "degenerate-shape")
        return None
    prism = prism_mesh(outlines, height)
    if len(prism.faces) == 0:
        report.warn(at, "a polyline without area; it is not drawn", "degenerate-shape")
        return None
    return prism


def _geometry(geometry: Geometry, at: Source, report: Diagnostics) -> ShapeGeometry | None:
    match geometry:
        case MeshFile(path=None) | Empty():
            return None
        case Heightmap(path=None):
            return None
        case Cone(radius, length):
            return cone_mesh(radius, length)
        case Polyline(outlines, height):
            return _prism(outlines, height, at, report)
        case Heightmap():
            from .terrain import painted_terrain  # imports Pillow, which is slow to load

            return painted_terrain(geometry, at, report)
        case MeshFile(path=path):
            assert path is not None  # unreadable meshes are reported above
        case _:
            return geometry
    try:
        mesh = meshes.load_mesh(path, submesh=geometry.submesh, center=geometry.center_submesh)
    except MeshError as error:
        report.warn(at, f"{error}; the shape is left out", error.id)
        return None
    empty = mesh.degenerate_face_count()
    if 2 * empty > len(mesh.faces):
        report.warn(
            at,
            f"{path.name}: {empty} of its {len(mesh.faces)} triangles have no area; only the others are drawn",
            "degenerate-shape",
        )
    for name in sorted({part.missing_texture for part in mesh.parts if part.missing_texture is not None}):
        report.info(
            Source(str(path)), f"its texture {name!r} is not in the model's folder; a plain color is drawn", "texture"
        )
    return mesh.scaled(geometry.scale)

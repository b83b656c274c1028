"""Shapes of roads."""

from collections.abc import Iterator

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.meshes import strip_mesh
from trundle.robots.model import World
from trundle.spatial import Pose

from .material_shape import material_shape
from .scene import Shape


def road_shapes(world: World, report: Diagnostics) -> Iterator[Shape]:
    """Yield each road on a static link, because shapes need a body."""
    links = [(model, link) for model in world.models for link in model.links]
    static_body = next((body for body, (model, link) in enumerate(links) if model.static or link.fixed), None)
    for road in world.roads:
        if static_body is None:
            report.warn(
                road.at,
                f"<road> {road.name!r}: nothing in this world is static to lay it on; it is not drawn",
                "road-without-ground",
            )
            continue
        model, link = links[static_body]
        world_from_body: Pose = model.world_from_model @ link.model_from_link
        shape = material_shape(road.name, static_body, strip_mesh(road.points, road.width), road.material)
        yield replace(shape, body_from_shape=world_from_body.inverse(), casts_shadow=False)

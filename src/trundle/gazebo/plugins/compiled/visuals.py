"""Drawings of compiled visual plugins: lines on the page, and changed visuals."""

from collections.abc import Sequence

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.robots.description import GAZEBO_MATERIALS
from trundle.robots.model import Link, Material, Visual
from trundle.sim.simulation import DebugLine, Simulation
from trundle.spatial import Pose, Vector3

_PAIRS = 1.0


def draw_line(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    """Draw a line in place of the last one of its name.

    Args:
        sim: the simulation.
        words: name and material; "": none.
        numbers: 1 for pairs of points, 0 for a strip; red, green and blue, from 0 to 1; the points in the world [m].
            Without any the line is removed.
    """
    name, material = words
    for old in [old for old in sim.lines if old == name or old.startswith(f"{name}/")]:
        del sim.lines[old]
    if not numbers:
        return
    kind, red, green, blue, *flat = numbers
    color = (red, green, blue) if not material else _material(material).diffuse[:3]
    points: list[Vector3] = [(flat[i], flat[i + 1], flat[i + 2]) for i in range(0, len(flat) - 2, 3)]
    if kind != _PAIRS:
        sim.lines[name] = DebugLine(color, points)
        return
    for i in range(0, len(points) - 1, 2):
        sim.lines[f"{name}/{i // 2}"] = DebugLine(color, points[i : i + 2])


def change_visual(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    """Change how a visual is drawn.

    Args:
        sim: the simulation.
        words: `model::link::visual` and material; "": the one that it has.
        numbers: its pose in the link's frame, and its transparency.
    """
    name, material = words
    x, y, z, qw, qx, qy, qz, transparency = numbers
    model_name, link_name, visual_name = name.split("::", 1)[0], *name.rsplit("::", 2)[-2:]

    def changed(visual: Visual) -> Visual:
        drawn = replace(visual, link_from_visual=Pose((x, y, z), (qw, qx, qy, qz)), transparency=transparency)
        return drawn if not material else replace(drawn, material=_material(material))

    def with_visual(link: Link) -> Link:
        if link.name != link_name and not link.name.endswith(f"::{link_name}"):
            return link
        visuals = (changed(visual) if visual.name == visual_name else visual for visual in link.visuals)
        return replace(link, visuals=tuple(visuals))

    models = tuple(
        replace(model, links=tuple(map(with_visual, model.links))) if model.name == model_name else model
        for model in sim.world.models
    )
    sim.edit(replace(sim.world, models=models))


def _material(name: str) -> Material:
    material = GAZEBO_MATERIALS.get(name)
    if material is None:
        raise UsageError(f"Gazebo has no material {name!r}")
    return material

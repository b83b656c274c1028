"""Looks of a picture: colours and textures of models, lights, ambient light and background."""

import math
from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError
from trundle.robots.meshes import Texture
from trundle.robots.model import Rgba
from trundle.sim.render import DEFAULT_LIGHTS, Scene, SceneLight, Shape, load_texture
from trundle.spatial import Vector3

from .instance import Instance
from .placer import Arrangement
from .plan import DatasetPlan, LightPlan, Paint
from .random_stream import LIGHTS, LOOKS, draw_colour, draw_numbers, random_stream

_WHITE = (1.0, 1.0, 1.0)
_FALL_OFF = (1.0, 0.0, 0.1)
"""Attenuation of a point light that the plan adds."""


class Looks:
    """Draws the looks of one scene."""

    def __init__(self, plan: DatasetPlan, scene: Scene, instances: Sequence[Instance]) -> None:
        """Find what is painted and lit.

        Raises:
            DescriptionError: the plan names a model or light that is not there, or a texture that cannot be read.
        """
        self._plan = plan
        self._scene = scene
        self._lights = scene.lights or DEFAULT_LIGHTS
        models = [scene.bodies[shape.body].partition("::")[0] for shape in scene.shapes]
        self._painted: list[tuple[str, Paint, list[int]]] = []
        """Model, its paint and its shapes."""
        self._placed = {each.model for each in instances}
        self.textures: list[Texture] = []
        """Every texture that a picture may show."""
        for each in instances:
            if each.model in plan.materials and _has_look(each.paint):
                what = f"object {each.model!r} has a look of its own; give one of them"
                raise DescriptionError(plan.materials[each.model].at, f"materials: {what}")
        paints = {each.model: each.paint for each in instances} | dict(plan.materials)
        for name, paint in paints.items():
            if name not in models:
                there = ", ".join(dict.fromkeys(models)) or "none"
                raise DescriptionError(paint.at, f"there is no model {name!r} with a visual; models: {there}")
            if _has_look(paint):
                self._painted.append((name, paint, [i for i, model in enumerate(models) if model == name]))
            for texture in paint.textures:
                self.textures.append(texture)
                image = load_texture(texture)
                if isinstance(image, str):
                    raise DescriptionError(paint.at, f"{texture!s} cannot be read: {image}")
        named = {light.name for light in self._lights}
        for light in plan.lights:
            if light.kind is None and light.name not in named:
                there = ", ".join(sorted(named)) or "none"
                what = f"the world has no light {light.name!r}; lights: {there}; `type: directional` or point adds one"
                raise DescriptionError(light.at, what)
            if light.kind is None:
                _check_kind(light, next(each for each in self._lights if each.name == light.name))

    def scene(self, number: int, arrangement: Arrangement) -> Scene:
        """Draw the looks of a picture."""
        absent = self._placed - {each.model for each in arrangement.present}
        random = random_stream(self._plan.seed, number, LOOKS)
        shapes = list(self._scene.shapes)
        for name, paint, numbers in self._painted:
            if name in absent:
                continue
            for i, shape in zip(numbers, _painted([shapes[i] for i in numbers], paint, random), strict=True):
                shapes[i] = shape
        random = random_stream(self._plan.seed, number, LIGHTS)
        ambient, background, sky = self._scene.ambient, self._scene.background, self._scene.sky
        if self._plan.ambient is not None:
            level = self._plan.ambient.draw(random)
            ambient = (level, level, level, 1.0)
        if self._plan.background is not None:
            background, sky = (*draw_colour(self._plan.background, random), 1.0), None
        return replace(
            self._scene,
            shapes=tuple(shapes),
            lights=tuple(self._draw_lights(random)),
            ambient=ambient,
            background=background,
            sky=sky,
        )

    def _draw_lights(self, random: np.random.Generator) -> list[SceneLight]:
        lights = list(self._lights)
        place = {light.name: i for i, light in enumerate(lights)}
        for plan in self._plan.lights:
            if plan.kind is None:
                lights[place[plan.name]] = _varied(lights[place[plan.name]], plan, random)
            else:
                new = SceneLight(name=plan.name, kind=plan.kind, casts_shadows=True)
                if plan.kind == "point":
                    new = replace(new, attenuation=_FALL_OFF)
                lights.append(_varied(new, plan, random))
        return lights


def _has_look(paint: Paint) -> bool:
    return paint.colour is not None or bool(paint.textures)


def _check_kind(plan: LightPlan, light: SceneLight) -> None:
    """Refuse numbers that a light of the world does not have.

    Raises:
        DescriptionError: with the light's line.
    """
    if light.kind == "point" and plan.elevation is not None:
        raise DescriptionError(plan.at, f"light {plan.name}: a point light has no `elevation`; leave it out")
    if light.kind == "directional" and plan.position is not None:
        what = "a directional light has no `position`; give `azimuth` and `elevation`"
        raise DescriptionError(plan.at, f"light {plan.name}: {what}")


def _painted(shapes: Sequence[Shape], paint: Paint, random: np.random.Generator) -> list[Shape]:
    """Return shapes of one colour and texture."""
    colour: Vector3 | None = None if paint.colour is None else draw_colour(paint.colour, random)
    if paint.textures:
        texture = paint.textures[int(random.integers(len(paint.textures)))]
        scale, rgb = 1.0 / paint.repeat.draw(random), colour or _WHITE
        return [
            replace(
                shape,
                texture=texture,
                texture_scale=(scale, scale),
                rgba=(*rgb, shape.rgba[3]),
                ambient=(*rgb, 1.0),
            )
            for shape in shapes
        ]
    assert colour is not None
    return [replace(shape, texture=None, rgba=(*colour, shape.rgba[3]), ambient=(*colour, 1.0)) for shape in shapes]


def _varied(light: SceneLight, plan: LightPlan, random: np.random.Generator) -> SceneLight:
    intensity, azimuth = plan.intensity.draw(random), plan.azimuth.draw(random)
    rgb = light.diffuse[:3] if plan.colour is None else draw_colour(plan.colour, random)
    direction, position = light.direction, light.position
    if plan.elevation is not None:
        elevation = plan.elevation.draw(random)
        flat = math.cos(elevation)
        direction = (-flat * math.cos(azimuth), -flat * math.sin(azimuth), -math.sin(elevation))
    if plan.position is not None:
        position = draw_numbers(plan.position, random)
    return replace(
        light,
        diffuse=_scaled((*rgb, 1.0), intensity),
        specular=_scaled(light.specular, intensity),
        direction=direction,
        position=position,
        casts_shadows=light.casts_shadows if plan.shadows is None else plan.shadows,
    )


def _scaled(colour: Rgba, factor: float) -> Rgba:
    return (colour[0] * factor, colour[1] * factor, colour[2] * factor, colour[3])

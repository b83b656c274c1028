"""Random looks of a picture: colors and textures of models, lights, ambient light and background."""

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
from .random_stream import LIGHTS, LOOKS, draw_color, draw_numbers, random_stream

_WHITE = (1.0, 1.0, 1.0)
_FALL_OFF = (1.0, 0.0, 0.1)
"""Attenuation of a point light that the plan adds: constant, linear, quadratic."""


class Looks:
    """Random looks of one scene."""

    def __init__(self, plan: DatasetPlan, scene: Scene, instances: Sequence[Instance]) -> None:
        """Find the painted shapes, the textures and the lights.

        Raises:
            DescriptionError: unknown model or light, or an unreadable texture.
        """
        self._plan = plan
        self._scene = scene
        self._lights = scene.lights or DEFAULT_LIGHTS
        models = [scene.bodies[shape.body].partition("::")[0] for shape in scene.shapes]
        self._painted: list[tuple[str, Paint, list[int]]] = []
        """Model, its paint and its shapes."""
        self._placed = {instance.model for instance in instances}
        self.textures: list[Texture] = []
        """Every texture that a picture may show."""
        for instance in instances:
            if instance.model in plan.materials and _has_look(instance.paint):
                message = f"object {instance.model!r} has a look of its own; give one of them"
                raise DescriptionError(plan.materials[instance.model].at, f"materials: {message}")
        paints = {instance.model: instance.paint for instance in instances} | dict(plan.materials)
        for name, paint in paints.items():
            if name not in models:
                names = ", ".join(dict.fromkeys(models)) or "none"
                raise DescriptionError(paint.at, f"there is no model {name!r} with a visual; models: {names}")
            if _has_look(paint):
                self._painted.append((name, paint, [i for i, model in enumerate(models) if model == name]))
            for texture in paint.textures:
                self.textures.append(texture)
                image = load_texture(texture)
                if isinstance(image, str):
                    raise DescriptionError(paint.at, f"{texture!s} cannot be read: {image}")
        light_names = {light.name for light in self._lights}
        for light in plan.lights:
            if light.kind is None and light.name not in light_names:
                names = ", ".join(sorted(light_names)) or "none"
                message = (
                    f"the world has no light {light.name!r}; lights: {names}; `type: directional` or point adds one"
                )
                raise DescriptionError(light.at, message)
            if light.kind is None:
                _check_kind(light, next(instance for instance in self._lights if instance.name == light.name))

    def scene(self, number: int, arrangement: Arrangement) -> Scene:
        """Draw the looks of a picture."""
        absent = self._placed - {instance.model for instance in arrangement.present}
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
            background, sky = (*draw_color(self._plan.background, random), 1.0), None
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
        index = {light.name: i for i, light in enumerate(lights)}
        for plan in self._plan.lights:
            if plan.kind is None:
                lights[index[plan.name]] = _varied(lights[index[plan.name]], plan, random)
            else:
                new = SceneLight(name=plan.name, kind=plan.kind, casts_shadows=True)
                if plan.kind == "point":
                    new = replace(new, attenuation=_FALL_OFF)
                lights.append(_varied(new, plan, random))
        return lights


def _has_look(paint: Paint) -> bool:
    return paint.color is not None or bool(paint.textures)


def _check_kind(plan: LightPlan, light: SceneLight) -> None:
    """Refuse parameters that a light of the world does not have.

    Raises:
        DescriptionError: the light has such a parameter.
    """
    if light.kind == "point" and plan.elevation is not None:
        raise DescriptionError(plan.at, f"light {plan.name}: a point light has no `elevation`; leave it out")
    if light.kind == "directional" and plan.position is not None:
        message = "a directional light has no `position`; give `azimuth` and `elevation`"
        raise DescriptionError(plan.at, f"light {plan.name}: {message}")


def _painted(shapes: Sequence[Shape], paint: Paint, random: np.random.Generator) -> list[Shape]:
    """Return shapes with one random color and texture."""
    color: Vector3 | None = None if paint.color is None else draw_color(paint.color, random)
    if paint.textures:
        texture = paint.textures[int(random.integers(len(paint.textures)))]
        scale, rgb = 1.0 / paint.repeat.draw(random), color or _WHITE
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
    assert color is not None
    return [replace(shape, texture=None, rgba=(*color, shape.rgba[3]), ambient=(*color, 1.0)) for shape in shapes]


def _varied(light: SceneLight, plan: LightPlan, random: np.random.Generator) -> SceneLight:
    intensity, azimuth = plan.intensity.draw(random), plan.azimuth.draw(random)
    rgb = light.diffuse[:3] if plan.color is None else draw_color(plan.color, random)
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


def _scaled(color: Rgba, factor: float) -> Rgba:
    return (color[0] * factor, color[1] * factor, color[2] * factor, color[3])

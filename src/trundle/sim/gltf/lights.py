"""Lights: SDF's as `extras.sdf`, and their approximation by KHR_lights_punctual."""

import math

from trundle.sim.render import SceneLight
from trundle.spatial import Quaternion, multiply, rotation_from_z

from .materials import linear_from_srgb

_MATCHED_M = 2.0
"""Distance at which a point light is as bright as SDF's attenuation says [m]."""


def punctual_light(light: SceneLight) -> dict[str, object]:
    """Return a light of KHR_lights_punctual; it shines along −z of its node."""
    fields: dict[str, object] = {
        "type": light.kind,
        "color": [linear_from_srgb(min(max(value, 0.0), 1.0)) for value in light.diffuse[:3]],
        "intensity": math.pi * _attenuation(light),  # π lx on a white surface reflects 1
        "extras": {"sdf": _sdf(light)},
    }
    if light.name:
        fields["name"] = light.name
    if light.kind != "directional" and 0.0 < light.range_m < 1e9:
        fields["range"] = light.range_m
    if light.kind == "spot":
        outer = min(max(light.outer_angle_rad / 2, 1e-3), math.pi / 2)
        inner = min(max(light.inner_angle_rad / 2, 0.0), outer - 1e-4)
        fields["spot"] = {"innerConeAngle": inner, "outerConeAngle": outer}
    return fields


def light_rotation(light: SceneLight) -> Quaternion:
    """Return the rotation of a light's node in its parent, whose −z is the light's direction."""
    return rotation_from_z(multiply(light.direction, -1.0))


def _attenuation(light: SceneLight) -> float:
    if light.kind == "directional":
        return 1.0
    constant, linear, quadratic = light.attenuation
    dimming = constant + linear * _MATCHED_M + quadratic * _MATCHED_M**2
    return _MATCHED_M**2 / dimming if dimming > 0.0 else _MATCHED_M**2


def _sdf(light: SceneLight) -> dict[str, object]:
    sdf: dict[str, object] = {
        "diffuse": light.diffuse,
        "specular": light.specular,
        "attenuation": light.attenuation,
        "cast_shadows": light.casts_shadows,
    }
    if light.kind == "spot":
        sdf["spot"] = {
            "inner_angle": light.inner_angle_rad,
            "outer_angle": light.outer_angle_rad,
            "falloff": light.falloff,
        }
    return sdf

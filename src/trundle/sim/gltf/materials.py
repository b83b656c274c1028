"""Materials: Phong's as `extras.sdf`, and their approximation by glTF's metallic-roughness model."""

from trundle.robots.model import Rgba
from trundle.sim.render import Shape


def linear_from_srgb(value: float) -> float:
    """Return the linear value of an sRGB component (IEC 61966-2-1)."""
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def material_from_shape(shape: Shape, texture: int | None) -> dict[str, object]:
    """Return the glTF material of a shape.

    Args:
        shape: shape with its colors.
        texture: index of its texture in the document.
    """
    *_, opacity = shape.rgba
    surface: dict[str, object] = {
        "baseColorFactor": [*_linear(shape.rgba), opacity],
        "metallicFactor": 0.0,
        # A Phong exponent n is as wide as a Beckmann lobe of α² = 2 / (n + 2), and glTF's roughness is √α
        # (Walter et al. 2007).
        "roughnessFactor": (2.0 / (max(shape.shininess, 0.0) + 2.0)) ** 0.25,
    }
    if texture is not None:
        surface["baseColorTexture"] = {"index": texture} | _transform(shape.texture_scale)
    material: dict[str, object] = {
        "pbrMetallicRoughness": surface,
        "extras": {
            "sdf": {
                "ambient": shape.ambient or shape.rgba,
                "diffuse": shape.rgba,
                "specular": shape.specular,
                "emissive": shape.emissive,
                "shininess": shape.shininess,
                "lighting": True,
            }
        },
    }
    if any(shape.emissive[:3]):
        material["emissiveFactor"] = _linear(shape.emissive)
    if opacity < 1.0:
        material["alphaMode"] = "BLEND"
    return material


def _linear(color: Rgba) -> list[float]:
    return [linear_from_srgb(min(max(value, 0.0), 1.0)) for value in color[:3]]


def _transform(scale: tuple[float, float]) -> dict[str, object]:
    """Return the texture transform of a scale about the image's centre."""
    if scale == (1.0, 1.0):
        return {}
    repeat = [1.0 / factor if factor else 1.0 for factor in scale]
    offset = [0.5 - 0.5 * factor for factor in repeat]
    return {"extensions": {"KHR_texture_transform": {"offset": offset, "scale": repeat}}}

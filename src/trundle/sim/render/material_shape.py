"""Shapes with the materials of a description."""

from trundle.robots.meshes import Mesh
from trundle.robots.model import Material, with_plain_color

from .scene import Shape, ShapeGeometry


def material_shape(name: str, body: int, geometry: ShapeGeometry, material: Material) -> Shape:
    """Return a shape with a material; a mesh without texture coordinates has a named texture's color only."""
    texture = material.texture
    if isinstance(geometry, Mesh) and geometry.uv is None:
        material = with_plain_color(material)
    if material.named_texture is not None:
        from .named_textures import named_texture  # most worlds have none

        texture = texture or named_texture(material.named_texture)
    return Shape(
        name=name,
        body=body,
        geometry=geometry,
        rgba=material.diffuse,
        ambient=material.ambient,
        specular=material.specular,
        emissive=material.emissive,
        texture=texture,
        texture_scale=material.texture_scale,
    )

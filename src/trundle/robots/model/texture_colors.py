"""Colors of Gazebo's named materials whose textures are made by `render`."""

from msgspec.structs import replace

from .material import Material, Rgba

TEXTURE_COLORS: dict[str, tuple[float, float, float]] = {
    "Gazebo/Wood": (0.55, 0.35, 0.2),
    "Gazebo/WoodFloor": (0.55, 0.35, 0.2),
    "Gazebo/WoodPallet": (0.6, 0.45, 0.28),
    "Gazebo/Bricks": (0.55, 0.25, 0.2),
    "Gazebo/CeilingTiled": (0.8, 0.8, 0.78),
    "Gazebo/PaintedWall": (0.8, 0.8, 0.75),
    "Gazebo/CloudySky": (0.6, 0.75, 0.9),
    "Gazebo/Road": (0.25, 0.25, 0.25),
    "Gazebo/Residential": (0.25, 0.25, 0.25),
    "Gazebo/Tertiary": (0.25, 0.25, 0.25),
    "Gazebo/Pedestrian": (0.45, 0.45, 0.45),
    "Gazebo/Footway": (0.45, 0.45, 0.45),
    "Gazebo/Motorway": (0.22, 0.22, 0.22),
    "Gazebo/Lanes_6": (0.22, 0.22, 0.22),
    "Gazebo/Trunk": (0.24, 0.24, 0.24),
    "Gazebo/Lanes_4": (0.24, 0.24, 0.24),
    "Gazebo/Primary": (0.25, 0.25, 0.25),
    "Gazebo/Lanes_2": (0.25, 0.25, 0.25),
    "Gazebo/Secondary": (0.26, 0.26, 0.26),
    "Gazebo/Lane_1": (0.26, 0.26, 0.26),
    "Gazebo/Steps": (0.5, 0.5, 0.5),
    "Gazebo/Runway": (0.3, 0.3, 0.3),
    "Gazebo/Grass": (0.25, 0.45, 0.2),
}
"""Name → mean color of the texture, chosen for Trundle."""


def with_plain_color(material: Material) -> Material:
    """Return a material without its named texture, in the texture's color."""
    if material.named_texture is None:
        return material
    r, g, b = TEXTURE_COLORS[material.named_texture]

    def tinted(color: Rgba) -> Rgba:
        return (color[0] * r, color[1] * g, color[2] * b, color[3])

    return replace(material, ambient=tinted(material.ambient), diffuse=tinted(material.diffuse), named_texture=None)

"""Colors of Gazebo's named materials, from its Ogre scripts."""

from trundle.robots.model import Material, Rgba

_Rgb = tuple[float, float, float]


def _material(ambient: _Rgb, diffuse: _Rgb, specular: _Rgb, emissive: _Rgb, opacity: float = 1.0) -> Material:
    def rgba(rgb: _Rgb) -> Rgba:
        return (*rgb, opacity)

    return Material(ambient=rgba(ambient), diffuse=rgba(diffuse), specular=rgba(specular), emissive=rgba(emissive))


_NONE: _Rgb = (0.0, 0.0, 0.0)

GAZEBO_MATERIALS: dict[str, Material] = {
    "Gazebo/Reflectance": _material((0.7, 0.7, 0.7), (0.7, 0.7, 0.7), _NONE, _NONE),
    "Gazebo/Grey": _material((0.3, 0.3, 0.3), (0.7, 0.7, 0.7), (0.01, 0.01, 0.01), _NONE),
    "Gazebo/Gray": _material((0.3, 0.3, 0.3), (0.7, 0.7, 0.7), (0.01, 0.01, 0.01), _NONE),
    "Gazebo/DarkGrey": _material((0.175, 0.175, 0.175), (0.175, 0.175, 0.175), (0.175, 0.175, 0.175), _NONE),
    "Gazebo/DarkGray": _material((0.175, 0.175, 0.175), (0.175, 0.175, 0.175), (0.175, 0.175, 0.175), _NONE),
    "Gazebo/White": _material((1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/FlatBlack": _material((0.1, 0.1, 0.1), (0.1, 0.1, 0.1), (0.01, 0.01, 0.01), _NONE),
    "Gazebo/Black": _material(_NONE, _NONE, (0.1, 0.1, 0.1), _NONE),
    "Gazebo/Red": _material((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/RedBright": _material((0.87, 0.26, 0.07), (0.87, 0.26, 0.07), (0.87, 0.26, 0.07), _NONE),
    "Gazebo/Green": _material((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/Blue": _material((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/SkyBlue": _material((0.13, 0.44, 0.7), (0.0, 0.0, 1.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/Yellow": _material((1.0, 1.0, 0.0), (1.0, 1.0, 0.0), _NONE, _NONE),
    "Gazebo/ZincYellow": _material((0.9725, 0.9529, 0.2078), (0.9725, 0.9529, 0.2078), (0.9725, 0.9529, 0.2078), _NONE),
    "Gazebo/DarkYellow": _material((0.7, 0.7, 0.0), (0.7, 0.7, 0.0), _NONE, _NONE),
    "Gazebo/Purple": _material((1.0, 0.0, 1.0), (1.0, 0.0, 1.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/Turquoise": _material((0.0, 1.0, 1.0), (0.0, 1.0, 1.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/Orange": _material((1.0, 0.5088, 0.0468), (1.0, 0.5088, 0.0468), (0.5, 0.5, 0.5), _NONE),
    "Gazebo/Indigo": _material((0.33, 0.0, 0.5), (0.33, 0.0, 0.5), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/WhiteGlow": _material((1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (0.1, 0.1, 0.1), (1.0, 1.0, 1.0)),
    "Gazebo/RedGlow": _material((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), _NONE, (1.0, 0.0, 0.0)),
    "Gazebo/GreenGlow": _material((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), (0.1, 0.1, 0.1), (0.0, 1.0, 0.0)),
    "Gazebo/BlueGlow": _material((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), (0.1, 0.1, 0.1), (0.0, 0.0, 1.0)),
    "Gazebo/YellowGlow": _material((1.0, 1.0, 0.0), (1.0, 1.0, 0.0), _NONE, (1.0, 1.0, 0.0)),
    "Gazebo/PurpleGlow": _material((1.0, 0.0, 1.0), (1.0, 0.0, 1.0), (0.1, 0.1, 0.1), (1.0, 0.0, 1.0)),
    "Gazebo/TurquoiseGlow": _material((0.0, 1.0, 1.0), (0.0, 1.0, 1.0), (0.1, 0.1, 0.1), (0.0, 1.0, 1.0)),
    "Gazebo/TurquoiseGlowOutline": _material((0.0, 1.0, 1.0), (0.0, 1.0, 1.0), (0.1, 0.1, 0.1), (0.0, 1.0, 1.0)),
    "Gazebo/RedTransparentOverlay": _material((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), _NONE, _NONE, 0.5),
    "Gazebo/BlueTransparentOverlay": _material((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), _NONE, _NONE, 0.5),
    "Gazebo/GreenTransparentOverlay": _material((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), _NONE, _NONE, 0.5),
    "Gazebo/OrangeTransparentOverlay": _material((1.0, 0.5088, 0.0468), (1.0, 0.5088, 0.0468), _NONE, _NONE, 0.8),
    "Gazebo/DarkOrangeTransparentOverlay": _material((0.6, 0.305, 0.028), (0.6, 0.305, 0.028), _NONE, _NONE, 0.8),
    "Gazebo/RedTransparent": _material((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), _NONE, _NONE, 0.5),
    "Gazebo/GreenTransparent": _material((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), _NONE, _NONE, 0.5),
    "Gazebo/BlueTransparent": _material((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), _NONE, _NONE, 0.5),
    "Gazebo/DarkMagentaTransparent": _material((0.6, 0.0, 0.6), (0.6, 0.0, 0.6), _NONE, _NONE, 0.5),
    "Gazebo/GreyTransparent": _material((0.5, 0.5, 0.5), (0.5, 0.5, 0.5), _NONE, _NONE, 0.5),
    "Gazebo/BlackTransparent": _material(_NONE, _NONE, _NONE, _NONE, 0.5),
    "Gazebo/YellowTransparent": _material((1.0, 1.0, 0.0), (1.0, 1.0, 0.0), _NONE, _NONE, 0.5),
    "Gazebo/LightOn": _material((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), _NONE, (0.0, 1.0, 0.0)),
    "Gazebo/LightOff": _material((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), _NONE, (1.0, 0.0, 0.0)),
    "Gazebo/LightBlueLaser": _material((0.5, 0.5, 1.0), (0.5, 0.5, 1.0), _NONE, _NONE, 0.4),
    "Gazebo/BlueLaser": _material((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), _NONE, _NONE, 0.4),
    "Gazebo/OrangeTransparent": _material((1.0, 0.44, 0.0), (1.0, 0.44, 0.0), _NONE, _NONE, 0.4),
    "Gazebo/JointAnchor": _material((1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)),
    "Gazebo/Pioneer2Body": _material(
        (0.481193, 0.000123, 0.000123), (0.681193, 0.000923, 0.000923), (0.5, 0.5, 0.5), _NONE
    ),
    "Gazebo/Gold": _material((0.4, 0.24869, 0.020759), (0.8, 0.64869, 0.120759), (0.4, 0.4, 0.4), _NONE),
    "Gazebo/PointHandle": _material((0.7, 0.7, 0.7), (0.7, 0.7, 0.7), _NONE, _NONE),
    "Gazebo/Editor": _material((1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (0.1, 0.1, 0.1), _NONE),
    "Gazebo/EditorPlane": _material((0.3, 0.3, 0.3), (0.7, 0.7, 0.7), (0.01, 0.01, 0.01), _NONE),
}
"""Name → colors, without the green overlay that the scripts give *Transparent by mistake."""

PLAIN: dict[str, _Rgb] = {
    "Gazebo/CoM": (0.9, 0.9, 0.2),
    "Gazebo/GreyGradientSky": (0.7, 0.7, 0.75),
    "Gazebo/BuildingFrame": (0.6, 0.6, 0.6),
    "Gazebo/PioneerBody": (1.0, 0.0, 0.0),
    "Gazebo/WindowFrame": (0.5, 0.5, 0.5),
}
"""Materials whose texture only Gazebo ships → similar plain color, chosen for Trundle."""

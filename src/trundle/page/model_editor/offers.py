"""Lists of the plugins, sensors, joints and meshes that can be added to a draft."""

from trundle.gazebo.plugins import BUILTIN, SENSOR_PLUGINS, plugin_documentation
from trundle.robots.packages import Packages

from ..requests.answers import DraftOffers, PluginOffer
from .joint_fields import JOINT_TYPES
from .sensor_fields import SENSOR_TYPES

_MESH_SUFFIXES = (".dae", ".stl", ".obj", ".glb", ".gltf")
_MAX_MESHES = 500


def draft_offers(packages: Packages) -> DraftOffers:
    """Return the parts that can be added to a draft."""
    plugins = (PluginOffer(filename=name, about=_about(name)) for name in sorted({*BUILTIN, *SENSOR_PLUGINS}))
    return DraftOffers(
        plugins=tuple(plugins), sensors=SENSOR_TYPES, joints=JOINT_TYPES, meshes=tuple(_meshes(packages))
    )


def _about(filename: str) -> str:
    documentation = plugin_documentation(filename)
    return "" if documentation is None else documentation.about


def _meshes(packages: Packages) -> list[str]:
    """Return URIs of the meshes of models, up to the limit."""
    uris: list[str] = []
    for name, folder in sorted(packages.models().items()):
        meshes = folder / "meshes"
        if not meshes.is_dir():
            continue
        files = sorted(file for file in meshes.iterdir() if file.suffix.lower() in _MESH_SUFFIXES)
        uris += [f"model://{name}/meshes/{file.name}" for file in files]
        if len(uris) >= _MAX_MESHES:
            return uris[:_MAX_MESHES]
    return uris

"""Lists of what a draft can be given: plugins, sensors, meshes of the model path."""

from trundle.gazebo.plugins import BUILTIN, SENSOR_PLUGINS, plugin_documentation
from trundle.robots.packages import Packages

from ..requests.answers import DraftOffers, PluginOffer
from .joint_fields import JOINT_TYPES
from .sensor_fields import SENSOR_TYPES

_MESHES = (".dae", ".stl", ".obj", ".glb", ".gltf")
_MAX_MESHES = 500


def draft_offers(packages: Packages) -> DraftOffers:
    """Return what a draft can be given."""
    plugins = (PluginOffer(filename=name, about=_about(name)) for name in sorted({*BUILTIN, *SENSOR_PLUGINS}))
    return DraftOffers(
        plugins=tuple(plugins), sensors=SENSOR_TYPES, joints=JOINT_TYPES, meshes=tuple(_meshes(packages))
    )


def _about(filename: str) -> str:
    documentation = plugin_documentation(filename)
    return "" if documentation is None else documentation.about


def _meshes(packages: Packages) -> list[str]:
    """Return URIs of the meshes of models, the first if they are very many."""
    found: list[str] = []
    for name, folder in sorted(packages.models().items()):
        meshes = folder / "meshes"
        if not meshes.is_dir():
            continue
        files = sorted(each for each in meshes.iterdir() if each.suffix.lower() in _MESHES)
        found += [f"model://{name}/meshes/{each.name}" for each in files]
        if len(found) >= _MAX_MESHES:
            return found[:_MAX_MESHES]
    return found

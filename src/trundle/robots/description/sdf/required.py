"""Check of attributes that SDF requires: Gazebo refuses a file without them; here they are a warning."""

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode

from .version import Version

_NAME, _NAME_TYPE = ("name",), ("name", "type")
_LINK = {"collision": _NAME, "visual": _NAME, "sensor": _NAME_TYPE, "light": _NAME_TYPE, "projector": _NAME}
_REQUIRED = {
    "sdf": {"world": _NAME, "light": _NAME_TYPE},
    "world": {"light": _NAME_TYPE, "physics": ("type",), "state": ("world_name",), "population": _NAME},
    "model": {"gripper": _NAME},
    "link": _LINK,
    "joint": {"sensor": _NAME_TYPE},
    "gazebo": {"sensor": _NAME_TYPE},
}
"""Element → children → required attributes; attributes whose absence is an error here too are checked elsewhere."""
_HOLDERS = {*_REQUIRED, "sensor", "visual", "actor", "population"}
"""Elements that may contain such children or plugins."""
_PLUGIN, _PLUGIN_FROM_1_10 = ("name", "filename"), ("filename",)


def name_missing_attributes(root: XmlNode, version: Version, report: Diagnostics) -> None:
    """Warn of each missing or empty attribute below a root element or a URDF's <gazebo> block."""
    plugin = _PLUGIN if version < (1, 10) else _PLUGIN_FROM_1_10
    pending = [root]
    while pending:
        node = pending.pop()
        required = _REQUIRED.get(node.tag, {})
        for child in node.children:
            tag = child.tag
            for attribute in plugin if tag == "plugin" else required.get(tag, ()):
                value = child.attribute(attribute)
                if value is None or not value.strip():
                    fault = f"without {attribute!r}" if value is None else f"with an empty {attribute!r}"
                    report.warn(child.at, f"<{tag}> {fault}; Gazebo refuses the whole file", "gazebo-refuses")
            if tag in _HOLDERS:
                pending.append(child)

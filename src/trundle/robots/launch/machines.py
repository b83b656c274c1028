"""Reader of <machine>."""

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode

from .attributes import Attributes
from .plan_builder import PlanBuilder
from .scope import Scope
from .substitution import Substitution

_ATTRIBUTES = ("name", "address", "env-loader", "ssh-port", "user", "password", "default", "timeout")
_REMOVED = ("ros-root", "ros-package-path", "ros-ip", "ros-hostname")
_DEFAULTS = ("true", "false", "never")


def read_machine(
    node: XmlNode, scope: Scope, substitution: Substitution, builder: PlanBuilder, report: Diagnostics
) -> None:
    """Read a <machine>; a default machine applies to the nodes after it.

    Raises:
        DescriptionError: roslaunch rejects it too.
    """
    attributes = Attributes(node, scope, substitution, report, (*_ATTRIBUTES, *_REMOVED))
    if not attributes.is_active:
        return
    removed = [name for name in _REMOVED if node.attribute(name)] + [
        "<env>" for child in node.children if child.tag == "env"
    ]
    if removed:
        raise DescriptionError(
            node.at,
            f"<machine> has no {removed[0]} since ROS Fuerte; an 'env-loader' sets what it set",
            "launch-machine",
        )
    name, address = attributes.required("name"), attributes.required("address")
    default = (attributes.text("default") or "false").lower()
    if default not in _DEFAULTS:
        raise DescriptionError(
            node.at, f"machine {name!r}: default {default!r}; there are {', '.join(_DEFAULTS)}", "launch-machine"
        )
    port = attributes.text("ssh-port") or "22"
    if not port.strip().isdecimal():
        raise DescriptionError(node.at, f"machine {name!r}: ssh-port {port!r} is not a whole number", "launch-machine")
    timeout_s = attributes.number("timeout", default=10.0)
    if not timeout_s > 0.0:
        raise DescriptionError(node.at, f"machine {name!r}: timeout must be > 0 s, got {timeout_s:g}", "launch-machine")
    for child in node.children:
        report.warn(child.at, f"<{child.tag}> in <machine> is not known; it is ignored", "unsupported-element")
    login = tuple(attributes.text(word) for word in ("env-loader", "user", "password"))
    builder.add_machine(name, (address, *login, int(port), timeout_s, default == "never"), node.at)
    if default == "true":
        builder.default_machine = name

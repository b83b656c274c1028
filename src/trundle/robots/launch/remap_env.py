"""<remap> and <env>, which apply to the nodes after them."""

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.names import canonical_name, is_legal_name

from .attributes import Attributes
from .scope import Scope
from .substitution import Substitution


def read_remap(node: XmlNode, scope: Scope, target: Scope, substitution: Substitution, report: Diagnostics) -> None:
    """Read a <remap>, substituted in `scope`, into `target`.

    Raises:
        DescriptionError: a name is absent or not legal.
    """
    attributes = Attributes(node, scope, substitution, report, ("from", "to"))
    if not attributes.is_active:
        return
    names = {label: canonical_name(attributes.required(label)) for label in ("from", "to")}
    for label, name in names.items():
        if not is_legal_name(name):
            raise DescriptionError(node.at, f"remap {label} {name!r}: not a legal ROS name", "launch-remap")
    target.remap(names["from"], names["to"])


def read_env(node: XmlNode, scope: Scope, target: Scope, substitution: Substitution, report: Diagnostics) -> None:
    """Read an <env>, substituted in `scope`, into `target`.

    Raises:
        DescriptionError: no name or no value.
    """
    attributes = Attributes(node, scope, substitution, report, ("name", "value"))
    if attributes.is_active:
        target.env.append((attributes.required("name"), attributes.required("value", empty=True)))

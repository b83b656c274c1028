"""<param> and <rosparam>."""

from typing import Literal

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.names import join_names

from .attributes import Attributes
from .plan import ParamCommand, ParamStep, ParamType, ParamValue
from .plan_builder import PlanBuilder
from .scope import Scope
from .substitution import Substitution
from .values import convert_value, load_yaml

_TYPES: dict[str, ParamType] = {
    "auto": "auto",
    "str": "str",
    "string": "str",
    "int": "int",
    "double": "double",
    "bool": "bool",
    "boolean": "bool",
    "yaml": "yaml",
}
_SOURCES = ("value", "textfile", "binfile", "command")
PARAM_ATTRIBUTES = ("name", "type", *_SOURCES)


def read_param(attributes: Attributes) -> tuple[str, ParamValue | ParamCommand]:
    """Read a <param>: its name as written, and its value or command.

    Raises:
        DescriptionError: no name, not exactly one source of the value, or a value that does not fit its type.
    """
    at = attributes.at
    sources = {source: text for source in _SOURCES if (text := attributes.text(source)) is not None}
    name = attributes.required("name").strip()
    if len(sources) != 1:
        listed = "none" if not sources else " and ".join(map(repr, sources))
        raise DescriptionError(
            at, f"param {name!r} needs one of {', '.join(map(repr, _SOURCES))}; it has {listed}", "launch-param"
        )
    ((source, text),) = sources.items()
    # This attribute is not substituted, as in roslaunch.
    type_name = (attributes.node.attribute("type") or "auto").lower().strip()
    if type_name not in _TYPES:
        raise DescriptionError(
            at, f"param {name!r}: no type {type_name!r}; types are {', '.join(_TYPES)}", "launch-param"
        )
    kind = _TYPES[type_name]
    try:
        match source:
            case "value":
                return name, convert_value(text.strip(), kind, attributes.count_values)
            case "textfile":
                return name, convert_value(attributes.read_file(text).decode(), kind, attributes.count_values)
            case "binfile":
                return name, attributes.read_file(text)
            case _:
                return name, ParamCommand(line=text, type=kind, at=at)
    except UnicodeDecodeError:
        raise DescriptionError(at, f"param {name!r}: {text!r} is not a text file", "launch-param") from None
    except ValueError as error:
        raise DescriptionError(at, f"param {name!r}: {error}", "launch-param") from None


def read_rosparam(
    node: XmlNode, scope: Scope, substitution: Substitution, builder: PlanBuilder, report: Diagnostics
) -> None:
    """Read a <rosparam>; `load` sets parameters, `dump` and `delete` become steps.

    Raises:
        DescriptionError: unreadable YAML, a missing file, or attributes that exclude each other.
    """
    attributes = Attributes(node, scope, substitution, report, ("command", "ns", "file", "param", "subst_value"))
    if not attributes.is_active:
        return
    # `ns` is an old attribute; it comes before `param` in the name.
    suffix = join_names(attributes.text("ns") or "", attributes.text("param") or "")
    name = scope.join(suffix) if suffix else scope.namespace
    command = attributes.text("command") or "load"
    file = attributes.text("file")
    match command:
        case "load":
            _load(attributes, builder, name, file, needs_mapping=not suffix or name == "/")
        case "dump" | "delete":
            _step(attributes, builder, command, name, file)
        case _:
            raise DescriptionError(
                node.at, f"rosparam command {command!r}; there are 'load', 'dump', 'delete'", "rosparam"
            )


def _step(
    attributes: Attributes, builder: PlanBuilder, command: Literal["dump", "delete"], name: str, file: str | None
) -> None:
    if command == "delete" and file is not None:
        raise DescriptionError(attributes.at, "rosparam delete takes no 'file'", "rosparam")
    if command == "dump" and not file:
        raise DescriptionError(attributes.at, "rosparam dump needs the attribute 'file'", "rosparam")
    builder.add_step(ParamStep(command=command, name=name, file=file or "", at=attributes.at))


def _load(attributes: Attributes, builder: PlanBuilder, name: str, file: str | None, *, needs_mapping: bool) -> None:
    at = attributes.at
    try:
        text = attributes.read_file(file).decode() if file is not None else attributes.node.raw_text
        text = attributes.resolve(text) if attributes.flag("subst_value") else text
        data = load_yaml(text, attributes.count_values)
    except UnicodeDecodeError:
        raise DescriptionError(at, f"rosparam: {file!r} is not a text file", "rosparam") from None
    except ValueError as error:
        raise DescriptionError(at, f"rosparam{'' if file is None else f' {file!r}'}: {error}", "rosparam") from None
    if data is None:
        data = {}
    if needs_mapping and not isinstance(data, dict):
        raise DescriptionError(at, "rosparam needs the attribute 'param' where its YAML is not a mapping", "rosparam")
    _set(builder, name, data, attributes)


def _set(builder: PlanBuilder, name: str, value: ParamValue, attributes: Attributes) -> None:
    """Set a value; a mapping sets one parameter per leaf."""
    if not isinstance(value, dict):
        builder.set_param(name, value, attributes.at)
        return
    for key, item in value.items():
        _set(builder, join_names(name, key), item, attributes)

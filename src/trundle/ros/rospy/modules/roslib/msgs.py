"""Parsed definitions of messages, under the names that programs before 2013 import; genmsg replaced them."""

from pathlib import Path
from typing import Any

import genmsg.msgs
from genmsg.msgs import (
    BUILTIN_TYPES as BUILTIN_TYPES,
    DURATION as DURATION,
    HEADER as HEADER,
    PRIMITIVE_TYPES as PRIMITIVE_TYPES,
    TIME as TIME,
    Constant as Constant,
    Field as Field,
    is_builtin as is_builtin,
    is_header_type as is_header_type,
    is_valid_msg_type as is_valid_msg_type,
    resolve_type as resolve_type,
)
from trundle.base.files import read_text
from trundle.ros.errors import MessageError
from trundle.ros.rospy.message_classes import parse_definition
from trundle.ros.rospy.message_sources import find_definitions

from .names import is_legal_resource_base_name, package_resource_name
from .packages import resource_file

base_msg_type = genmsg.msgs.bare_msg_type
is_valid_msg_field_name = is_legal_resource_base_name
EXT, SEP = ".msg", "/"
CONSTCHAR, COMMENTCHAR = "=", "#"
RESERVED_TYPES = [*BUILTIN_TYPES, HEADER]
_MAX_BYTES = 1_000_000


class MsgSpecException(Exception):
    """A definition cannot be parsed, or is not found."""


class MsgSpec(genmsg.msgs.MsgSpec):
    """A parsed definition, whose text contains the added definitions of its fields' types."""

    def __str__(self) -> str:
        return _listed(self)


REGISTERED_TYPES: dict[str, MsgSpec] = {}


def parse_type(type_: str) -> tuple[str, bool, int | None]:
    """Element type, whether it is an array, and the array's fixed length.

    Raises:
        MsgSpecException: not a type.
    """
    try:
        return genmsg.msgs.parse_type(type_)
    except ValueError as error:
        raise MsgSpecException(str(error)) from None


def is_valid_constant_type(x: str) -> bool:
    """True for types that constants can have."""
    return x in PRIMITIVE_TYPES


def list_msg_types(package: str, include_depends: bool) -> list[str]:
    """Names of a package's messages; messages of its dependencies with their package."""
    names = find_definitions(package).names("msg")
    if include_depends:
        from rospkg import RosPack

        depends = RosPack().get_depends(package)
        names += [f"{other}{SEP}{name}" for other in depends for name in find_definitions(other).names("msg")]
    return names


def msg_file(package: str, type_: str) -> str:
    """Path of the file that would define a message.

    Raises:
        InvalidROSPkgException: the package has no folder.
    """
    return resource_file(package, "msg", f"{type_}{EXT}")


def load_from_string(text: str, package_context: str = "", full_name: str = "", short_name: str = "") -> MsgSpec:
    """Parse a definition; types of the same package get `package_context` as their package.

    Raises:
        MsgSpecException: it cannot be parsed.
    """
    try:
        spec = parse_definition(f"{package_context}{SEP}{short_name}", text)
    except MessageError as error:
        raise MsgSpecException(str(error)) from None
    header = "std_msgs/Header" if "std_msgs/Header" in text else HEADER
    types = [field.type.removeprefix(SEP).replace("std_msgs/Header", header) for field in spec.fields]
    constants = [Constant(constant.type, constant.name, constant.value, constant.text) for constant in spec.constants]
    return MsgSpec(
        types, [field.name for field in spec.fields], constants, text, full_name, package_context, short_name
    )


def load_from_file(file_path: str, package_context: str = "") -> tuple[str, MsgSpec]:
    """Parse a file; returns the type's name and its definition.

    Raises:
        MsgSpecException: it cannot be parsed.
        OSError: it cannot be read.
    """
    name, package = Path(file_path).name.removesuffix(EXT), package_context.rstrip(SEP)
    return _load(package, name, read_text(file_path, max_bytes=_MAX_BYTES))


def load_by_type(msgtype: str, package_context: str = "") -> tuple[str, MsgSpec]:
    """Name and definition of a type.

    Raises:
        MsgSpecException: it is not found, or cannot be parsed.
    """
    package, name = package_resource_name(msgtype)
    package = package or package_context
    text = find_definitions(package).message(name)
    if text is None:
        raise MsgSpecException(f"Cannot locate message type [{msgtype}], package [{package}] does not define it")
    return _load(package, name, text.replace("std_msgs/Header ", f"{HEADER} "))  # as in the package's file


def get_pkg_msg_specs(package: str) -> tuple[list[tuple[str, MsgSpec]], list[str]]:
    """Pairs (name, definition) of a package's types, and the names of types that cannot be parsed."""
    specs: list[tuple[str, MsgSpec]] = []
    failures: list[str] = []
    for name in list_msg_types(package, include_depends=False):
        try:
            specs.append(load_by_type(name, package))
        except MsgSpecException as error:
            failures.append(name)
            print(f"ERROR: unable to load {name}, {error}")
    return specs, failures


def register(msg_type_name: str, msg_spec: MsgSpec) -> None:
    """Add a definition."""
    REGISTERED_TYPES[msg_type_name] = msg_spec


def is_registered(msg_type_name: str) -> bool:
    """True if a definition was added."""
    return msg_type_name in REGISTERED_TYPES


def get_registered(msg_type_name: str, default_package: str | None = None) -> MsgSpec:
    """Added definition.

    Raises:
        KeyError: it was not added.
    """
    if msg_type_name not in REGISTERED_TYPES and default_package:
        return REGISTERED_TYPES[f"{default_package}{SEP}{msg_type_name}"]
    return REGISTERED_TYPES[msg_type_name]


def load_package(package: str) -> None:
    """Add all definitions of a package."""
    for name, spec in get_pkg_msg_specs(package)[0]:
        register(name, spec)


def _listed(spec: MsgSpec, indent: str = "") -> str:
    """Constants and fields, one per line."""
    lines = [f"{indent}{constant.type} {constant.name}={constant.val_text}\n" for constant in spec.constants]
    for type_, name in spec.fields():
        lines.append(f"{indent}{type_} {name}\n")
        nested = REGISTERED_TYPES.get(base_msg_type(type_))
        lines += [] if nested is None else [_listed(nested, f"{indent}  ")]
    return "".join(lines)


def _load(package: str, name: str, text: str) -> tuple[str, MsgSpec]:
    full: Any = f"{package}{SEP}{name}" if package else name
    return full, load_from_string(text, package, full, name)

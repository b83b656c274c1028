"""Definitions of messages and services."""

from typing import Any

from trundle.ros.errors import MessageError
from trundle.ros.rospy.message_classes import message_class, message_spec, parse_definition, service_class
from trundle.ros.rospy.message_sources import find_definitions, service_halves

MODE_MSG, MODE_SRV = ".msg", ".srv"


class ROSMsgException(Exception):
    """Unknown type."""


def get_msg_text(type_: str, raw: bool = False, rospack: Any = None) -> str:
    """Definition of a message type, with nested types unless raw.

    Raises:
        ROSMsgException: there is none.
    """
    del rospack
    try:
        spec = message_spec(type_)
    except MessageError as error:
        raise ROSMsgException(str(error)) from None
    return spec.text if raw else _text(spec, "")


def get_srv_text(type_: str, raw: bool = False, rospack: Any = None) -> str:
    """Definition of a service type, with nested types unless raw.

    Raises:
        ROSMsgException: there is none.
    """
    del rospack
    package, _, name = type_.partition("/")
    text = find_definitions(package).service(name)
    if text is None:
        raise ROSMsgException(f"Unable to load srv [{type_}]")
    return text if raw else "---\n".join(_text(parse_definition(type_, half), "") for half in service_halves(text))


def list_msgs(package: str, rospack: Any = None) -> list[str]:
    """Message types of a package."""
    del rospack
    return [f"{package}/{name}" for name in find_definitions(package).names("msg")]


def list_srvs(package: str, rospack: Any = None) -> list[str]:
    """Service types of a package."""
    del rospack
    return [f"{package}/{name}" for name in find_definitions(package).names("srv")]


def list_types(package: str, mode: str = MODE_MSG, rospack: Any = None) -> list[str]:
    """Types of a package."""
    return (list_msgs if mode == MODE_MSG else list_srvs)(package, rospack)


def rosmsg_md5(mode: str, type_: str) -> str:
    """md5 sum of a type."""
    return (message_class if mode == MODE_MSG else service_class)(type_)._md5sum


def _text(spec: Any, indent: str) -> str:
    lines = [f"{indent}{constant.type} {constant.name}={constant.text}\n" for constant in spec.constants]
    for field in spec.fields:
        lines.append(f"{indent}{field.type} {field.name}\n")
        if field.is_message:
            lines.append(_text(message_spec(field.base), f"{indent}  "))
    return "".join(lines)

"""Parsed definitions by the names of their types."""

from typing import Any

from trundle.ros.errors import MessageError
from trundle.ros.rospy.message_classes import message_spec, parse_definition
from trundle.ros.rospy.message_sources import find_definitions, service_halves

from .base import InvalidMsgSpec
from .msgs import Constant, MsgSpec


class MsgNotFound(Exception):
    """Unknown type."""


class MsgContext:
    """Definitions loaded so far."""

    def __init__(self) -> None:
        self._specs: dict[str, MsgSpec] = {}

    @staticmethod
    def create_default() -> "MsgContext":
        """Create an empty context."""
        return MsgContext()

    def register(self, full_msg_type: str, msgspec: MsgSpec) -> None:
        """Add a definition."""
        self._specs[full_msg_type] = msgspec

    def is_registered(self, full_msg_type: str) -> bool:
        """True if a definition was added."""
        return full_msg_type in self._specs

    def get_registered(self, full_msg_type: str) -> MsgSpec:
        """Added definition.

        Raises:
            KeyError: it was not added.
        """
        return self._specs[full_msg_type]


def load_msg_by_type(msg_context: MsgContext, msg_type: str, search_path: Any = None) -> MsgSpec:
    """Definition of a message type.

    Raises:
        MsgNotFound: there is none.
        InvalidMsgSpec: it cannot be parsed.
    """
    del search_path
    package, _, name = msg_type.partition("/")
    if find_definitions(package).message(name) is None:
        raise MsgNotFound(f"Cannot locate message [{name}] in package [{package}]")
    try:
        spec = _converted(message_spec(msg_type))
    except MessageError as error:
        raise InvalidMsgSpec(str(error)) from None
    msg_context.register(msg_type, spec)
    return spec


def load_msg_from_string(msg_context: MsgContext, text: str, full_name: str) -> MsgSpec:
    """Parse a definition.

    Raises:
        InvalidMsgSpec: it cannot be parsed.
    """
    try:
        spec = _converted(parse_definition(full_name, text))
    except MessageError as error:
        raise InvalidMsgSpec(str(error)) from None
    msg_context.register(full_name, spec)
    return spec


class SrvSpec:
    """A parsed service."""

    def __init__(self, request: MsgSpec, response: MsgSpec, text: str, full_name: str) -> None:
        self.request, self.response, self.text, self.full_name = request, response, text, full_name
        self.package, _, self.short_name = full_name.partition("/")


def load_srv_by_type(msg_context: MsgContext, srv_type: str, search_path: Any = None) -> SrvSpec:
    """Definition of a service type.

    Raises:
        MsgNotFound: there is none.
        InvalidMsgSpec: it cannot be parsed.
    """
    del search_path
    package, _, name = srv_type.partition("/")
    text = find_definitions(package).service(name)
    if text is None:
        raise MsgNotFound(f"Cannot locate service [{name}] in package [{package}]")
    request, response = (
        load_msg_from_string(msg_context, half, f"{srv_type}{part}")
        for half, part in zip(service_halves(text), ("Request", "Response"), strict=True)
    )
    return SrvSpec(request, response, text, srv_type)


def load_depends(msg_context: MsgContext, spec: MsgSpec | SrvSpec, search_path: Any = None) -> None:
    """Add the definitions of all types that a definition contains.

    Raises:
        MsgNotFound: there is no such type.
        InvalidMsgSpec: a definition cannot be parsed.
    """
    if isinstance(spec, SrvSpec):
        for half in (spec.request, spec.response):
            load_depends(msg_context, half, search_path)
        return
    for field in spec.parsed_fields():
        if not field.is_builtin and not msg_context.is_registered(field.base_type):
            load_depends(msg_context, load_msg_by_type(msg_context, field.base_type), search_path)


def _converted(spec: Any) -> MsgSpec:
    constants = [Constant(constant.type, constant.name, constant.value, constant.text) for constant in spec.constants]
    types, names = [field.type for field in spec.fields], [field.name for field in spec.fields]
    return MsgSpec(types, names, constants, spec.text, spec.type)

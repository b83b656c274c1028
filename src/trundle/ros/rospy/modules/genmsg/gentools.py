"""md5 sums and full texts of definitions."""

from trundle.ros.rospy.message_classes import message_spec, parse_definition
from trundle.ros.rospy.message_spec import MessageSpec, canonical_text, full_text, md5sum

from .msg_loader import MsgContext, SrvSpec
from .msgs import MsgSpec


def compute_md5_text(msg_context: MsgContext, spec: MsgSpec) -> str:
    """Text that the md5 sum of a message covers."""
    return canonical_text(_parsed_spec(spec), lambda name: _find(msg_context, name))


def compute_md5(msg_context: MsgContext, spec: MsgSpec | SrvSpec) -> str:
    """md5 sum of a message or a service."""
    if isinstance(spec, MsgSpec):
        return md5sum(_parsed_spec(spec), lambda name: _find(msg_context, name))
    from hashlib import md5

    halves = (compute_md5_text(msg_context, half) for half in (spec.request, spec.response))
    return md5("".join(halves).encode()).hexdigest()


def compute_full_text(msg_context: MsgContext, spec: MsgSpec | SrvSpec) -> str:
    """Definition of a message with the definitions of its fields' types; the text of a service."""
    if isinstance(spec, SrvSpec):
        return spec.text
    return full_text(_parsed_spec(spec), lambda name: _find(msg_context, name))


def _parsed_spec(spec: MsgSpec) -> MessageSpec:
    return parse_definition(spec.full_name, spec.text)


def _find(msg_context: MsgContext, name: str) -> MessageSpec:
    return _parsed_spec(msg_context.get_registered(name)) if msg_context.is_registered(name) else message_spec(name)

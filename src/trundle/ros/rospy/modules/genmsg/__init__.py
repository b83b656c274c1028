"""Names of message types, and their parsed definitions."""

from .base import EXT_MSG, EXT_SRV, SEP, InvalidMsgSpec, MsgGenerationException, log, log_verbose
from .msg_loader import MsgContext, MsgNotFound, load_depends, load_msg_by_type, load_srv_by_type
from .msgs import HEADER, TIME, Constant, Field, MsgSpec, is_header_type
from .names import is_legal_resource_base_name, is_legal_resource_name, package_resource_name, resource_name_package

__all__ = [
    "EXT_MSG", "EXT_SRV", "HEADER", "SEP", "TIME", "Constant", "Field", "InvalidMsgSpec", "MsgContext",
    "MsgGenerationException", "MsgNotFound", "MsgSpec", "is_header_type", "is_legal_resource_base_name",
    "is_legal_resource_name", "load_depends", "load_msg_by_type", "load_srv_by_type", "log", "log_verbose",
    "package_resource_name", "resource_name_package",
]  # fmt: skip

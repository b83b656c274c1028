"""XML text to a tree that knows file and line and what of it nobody read: the only door to lxml."""

from .node import XmlNode, parse_numbers
from .parse import parse_xml, read_xml

__all__ = ["XmlNode", "parse_numbers", "parse_xml", "read_xml"]

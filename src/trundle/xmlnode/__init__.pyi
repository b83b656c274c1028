from .document import XmlDocument as XmlDocument
from .document import XmlElement as XmlElement
from .node import XmlNode as XmlNode
from .numbers import parse_numbers as parse_numbers
from .parse import parse_xml as parse_xml
from .parse import read_xml as read_xml

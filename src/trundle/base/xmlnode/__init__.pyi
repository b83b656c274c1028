from .document import XmlDocument as XmlDocument, XmlElement as XmlElement
from .node import XmlNode as XmlNode
from .numbers import parse_numbers as parse_numbers
from .parse import parse_xml as parse_xml, read_xml as read_xml
from .ranges import MAX_LENGTH as MAX_LENGTH, MAX_MASS as MAX_MASS, MAX_NUMBER as MAX_NUMBER, is_within as is_within
from .read_budget import ReadBudget as ReadBudget, ReadBudgetError as ReadBudgetError

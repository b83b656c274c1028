"""Messages, by the names that programs before 2012 import."""

from genpy import DeserializationError as DeserializationError
from genpy import Duration as Duration
from genpy import Message as Message
from genpy import SerializationError as SerializationError
from genpy import Time as Time
from genpy import TVal as TVal
from genpy.message import check_type as check_type
from genpy.message import fill_message_args as fill_message_args
from genpy.message import get_message_class as get_message_class
from genpy.message import get_printable_message_args as get_printable_message_args
from genpy.message import get_service_class as get_service_class
from genpy.message import strify_message as strify_message

ROSMessageException = Exception

"""Messages, under the names that programs before 2012 import."""

from genpy import (
    DeserializationError as DeserializationError,
    Duration as Duration,
    Message as Message,
    SerializationError as SerializationError,
    Time as Time,
    TVal as TVal,
)
from genpy.message import (
    check_type as check_type,
    fill_message_args as fill_message_args,
    get_message_class as get_message_class,
    get_printable_message_args as get_printable_message_args,
    get_service_class as get_service_class,
    strify_message as strify_message,
)

ROSMessageException = Exception

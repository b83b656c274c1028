"""Message classes from the definitions in connection headers and bags."""

from typing import Any

from trundle.ros.errors import MessageError

from .errors import MessageException


def generate_dynamic(core_type: str, msg_cat: str) -> dict[str, Any]:
    """Classes of a type and its dependencies, by name, from its full definition.

    Raises:
        MessageException: the definition is invalid.
    """
    from trundle.ros.rospy.message_classes import classes_from_text

    try:
        return classes_from_text(core_type, msg_cat)
    except MessageError as error:
        raise MessageException(str(error)) from None

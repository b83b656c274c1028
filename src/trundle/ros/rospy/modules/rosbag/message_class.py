"""Message classes of a bag's connections."""

import functools
from typing import Any

import genpy.dynamic
import genpy.message

from .exceptions import ROSBagException


@functools.lru_cache(maxsize=512)
def message_class(type_name: str, md5sum: str, definition: str) -> Any:
    """Class of a connection's messages: the installed one if its MD5 matches, else one generated from the definition.

    Raises:
        ROSBagException: the definition is invalid.
    """
    try:
        installed = genpy.message.get_message_class(type_name)
    except Exception:  # an installed package may be broken, while the bag has the definition
        installed = None
    if installed is not None and installed._md5sum == md5sum:
        return installed
    try:
        return genpy.dynamic.generate_dynamic(type_name, definition)[type_name]
    except (genpy.MessageException, KeyError) as error:
        raise ROSBagException(f"the bag's definition of {type_name} is invalid: {error}") from None

"""Waiting for services."""

import contextlib
import socket
import time
from typing import Any

import genpy
import rosgraph
from trundle.ros.transport.headers import encode_header

from . import core, names
from .exceptions import ROSException, ROSInterruptException

_POLL_S = 0.1
_CONTACT_S = 10.0
_WARNING_PERIOD_S = 10


def wait_for_service(service: str, timeout: Any = None) -> None:
    """Wait until a service is available.

    Args:
        service: resolved and remapped.
        timeout: seconds or Duration; None: no limit.

    Raises:
        ROSException: timeout.
        ROSInterruptException: shutdown.
        ValueError: a timeout of 0.
    """
    if isinstance(timeout, genpy.Duration):
        timeout = timeout.to_sec()
    if timeout == 0:
        raise ValueError("timeout must be non-zero")
    name = names.resolve_name(service)
    end = None if not timeout else time.time() + timeout
    has_failed = False
    while not core.is_shutdown() and (end is None or time.time() < end):
        try:
            uri = _contact(name, _CONTACT_S if end is None else max(0.01, end - time.time()))
        except OSError:
            has_failed = True
            core.logwarn_throttle(_WARNING_PERIOD_S, f"wait_for_service({name}): failed to contact, will keep trying")
        else:
            if uri is not None:
                if has_failed:
                    core.loginfo(f"wait_for_service({name}): finally were able to contact [{uri}]")
                return
        time.sleep(_POLL_S)
    if core.is_shutdown():
        raise ROSInterruptException("rospy shutdown")
    raise ROSException(f"timeout exceeded while waiting for service {name}")


def _contact(name: str, timeout_s: float) -> str | None:
    """URI of a service that answers; None if none is registered.

    Raises:
        OSError: it does not answer.
    """
    try:
        uri = str(rosgraph.Master(names.get_caller_id()).lookupService(name))
    except rosgraph.MasterException:
        return None
    with contextlib.suppress(core.ParameterInvalid):
        with socket.create_connection(core.parse_rosrpc_uri(uri), timeout=timeout_s) as connection:
            caller = core.get_caller_id()
            connection.sendall(encode_header({"probe": "1", "md5sum": "*", "callerid": caller, "service": name}))
        return uri
    return None

"""Blocking master proxy for short-lived commands; imports neither asyncio nor an HTTP library."""

import socket
from typing import Any

from trundle.base.shortage import shortage
from trundle.base.waiting import PERIOD_S, WaitNotice

from ..errors import MasterError, MasterUnreachableError, WireError
from ..transport.network import master_uri_from_env
from .http import MAX_BODY_BYTES, host_and_port, parse_head, request
from .xmlrpc_text import FaultError, decode_response, encode_call


class MasterProxy:
    """Blocking calls to the master, the parameter server or a node's slave API."""

    def __init__(self, uri: str | None = None, caller_id: str = "/trundle", *, timeout_s: float | None = None) -> None:
        """Create; each call opens a connection.

        Args:
            uri: URI of the server; ROS_MASTER_URI by default.
            caller_id: name of the calling node.
            timeout_s: timeout of each call [s]; None: wait for the answer until the connection breaks, as ROS does.
        """
        self.uri = uri or master_uri_from_env()
        self._caller_id = caller_id
        self._timeout_s = timeout_s

    def call(self, method: str, *arguments: object) -> Any:
        """Call a method with the caller ID prepended and return the answer's value.

        Raises:
            MasterUnreachableError: no answer.
            MasterError: the answer's code is not 1.
        """
        try:
            answer = blocking_call(self.uri, method, self._caller_id, *arguments, timeout_s=self._timeout_s)
        except (OSError, WireError) as error:
            raise MasterUnreachableError(self.uri, shortage(error) or str(error)) from None
        except FaultError as error:
            raise MasterError(f"{method}: {error}") from None
        if not isinstance(answer, list) or len(answer) != 3:
            raise MasterUnreachableError(self.uri, "the server there is not a ROS master")
        code, text, value = answer
        if code != 1:
            raise MasterError(str(text))
        return value


def blocking_call(uri: str, method: str, *arguments: object, timeout_s: float | None = None) -> Any:
    """Call a method and return the decoded response.

    Raises:
        OSError: the connection fails (TimeoutError: no response in time).
        WireError: the peer does not speak XML-RPC.
        FaultError: the response is a fault.
    """
    notice = WaitNotice(f"the answer of {uri} to {method}")
    with socket.create_connection(host_and_port(uri), timeout=timeout_s) as connection:
        connection.sendall(request(uri, encode_call(method, arguments)))
        connection.settimeout(PERIOD_S if timeout_s is None else timeout_s)
        data = bytearray()
        end = None
        while end is None or len(data) < end:
            try:
                chunk = connection.recv(65536)
            except TimeoutError:
                if timeout_s is not None:
                    raise
                notice.poll()
                continue
            if not chunk:
                break
            data += chunk
            head_end = data.find(b"\r\n\r\n") + 4
            if end is None and head_end >= 4:
                size = parse_head(bytes(data[:head_end])).body_bytes
                end = head_end + size if size is not None else MAX_BODY_BYTES
    head, separator, body = bytes(data).partition(b"\r\n\r\n")
    if not separator:
        raise WireError("the server there does not speak HTTP")
    if parse_head(head).start[1] != "200":
        raise WireError(f"it answers {' '.join(parse_head(head).start[1:])[:100]}")
    return decode_response(body)

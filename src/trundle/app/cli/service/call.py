"""`trundle service call`, and lookup of a service's type from its provider."""

import argparse
import asyncio
import sys
import time
from collections.abc import Iterable
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.ros import (
    GraphLoop,
    MasterError,
    MasterProxy,
    MessageError,
    MessagePrinter,
    Messages,
    Node,
    ServiceError,
    follow_time,
    probe_service,
)

from ..graph_command import global_name, master, running_node
from ..yaml_input import piped_documents, yaml_value

_SCRIPT = "rosservice"
_POLL_S = 0.1


def main(args: argparse.Namespace) -> int:
    """Call once, or once per request on standard input."""
    name = global_name(args.service, _SCRIPT)
    values = [yaml_value(text or "''") for text in args.values]
    proxy = master(_SCRIPT)
    while args.wait and not any(name == service for service, _ in proxy.call("getSystemState")[2]):
        time.sleep(_POLL_S)
    kind = service_type(proxy, name)
    with running_node("rosservice", args.words) as (loop, node):
        requests: Iterable[Any] = [values]
        if not values and loop.messages.fields(loop.messages.service(kind).request):
            if sys.stdin.isatty():
                raise UsageError(f"Please specify service arguments: {argument_names(kind, loop.messages)}")
            requests = (document if isinstance(document, list) else [document] for document in piped_documents())
        loop.run(follow_time(node))
        for request in requests:
            _call_once(loop, node, name, kind, request, verbose=args.verbose)
    return 0


def _call_once(loop: GraphLoop, node: Node, name: str, kind: str, values: list[Any], *, verbose: bool) -> None:
    types = loop.messages.service(kind)
    printer = MessagePrinter(messages=loop.messages)
    try:
        request = node.new(types.request, values[0] if len(values) == 1 and isinstance(values[0], dict) else values)
    except MessageError as error:
        arguments = "\n".join(f" * {value} (type {type(value).__name__})" for value in values)
        raise MessageError(
            f"Incompatible arguments to call service:\n{error}\nProvided arguments are:\n{arguments}\n\n"
            f"Service arguments are: [{argument_names(kind, loop.messages)}]"
        ) from None
    response = loop.run(node.call_service(name, kind, request, timeout_s=None), None)
    if verbose:
        print(f"{printer.text(request, types.request)}\n---")
    print(printer.text(response, types.response), flush=True)


def service_type(proxy: MasterProxy, name: str) -> str:
    """Query a service's type from its provider, since the master does not have it."""
    try:
        uri = str(proxy.call("lookupService", name))
    except MasterError:
        raise ServiceError(f"Service [{name}] is not available.") from None
    kind = asyncio.run(probe_service(uri, name, f"/{_SCRIPT}")).get("type")
    if not kind:
        raise ServiceError(f"Unable to determine type of service [{name}].")
    return kind.removesuffix("Request")  # some versions of roscpp append "Request"


def argument_names(kind: str, messages: Messages | None = None) -> str:
    """Return the names of a request's fields."""
    messages = messages or Messages()
    return " ".join(messages.fields(messages.service(kind).request))

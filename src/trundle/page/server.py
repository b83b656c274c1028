"""The page's process: HTTP, WebSockets and a node of the graph; it ends at the end of its input.

Only `PageServer.start` runs it, as `python -m trundle.page.server`. Standard input and output carry the messages of
`wire`; nothing else may write to them.
"""

import contextlib
import logging
import os
import signal
import socket
import sys
from concurrent.futures import Future
from pathlib import Path

from trundle.base.http.access import Access
from trundle.base.http.page_address import AllowedNames, PageAddress, network_addresses
from trundle.ros import GraphLoop

from .clients.assets import Assets
from .dispatcher import Page
from .http.client_files import ClientFiles
from .http.listening import AddressError, listen
from .http.server import HttpServer
from .wire import FromServer, Refused, Served, Start, frame, read_frame, start_decoder, to_server_decoder

_STOP_TIMEOUT_S = 0.5


class OwnerPipe:
    """Pipe to the owner, written on the loop only: messages are short, and the owner reads them at once."""

    def __init__(self) -> None:
        self._descriptor = os.dup(1)
        os.dup2(2, 1)

    def send(self, message: FromServer) -> None:
        """Send a message; the end of the input pipe reveals that the owner has ended."""
        data = frame(message)
        try:
            while data:
                data = data[os.write(self._descriptor, data) :]
        except OSError:
            return


def main() -> None:
    """Serve until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    pipe = OwnerPipe()
    try:
        start = start_decoder.decode(read_frame(sys.stdin.buffer))
        address = PageAddress(
            host=start.host,
            port=start.port,
            reserved_ports=start.reserved_ports,
            allowed=AllowedNames(hosts=start.hosts, origins=start.origins),
        )
        listening = listen(address)
    except EOFError:
        return
    except AddressError as error:
        pipe.send(Refused(str(error)))
        return
    loop = GraphLoop()
    loop.start()
    page = loop.run(_serve(start, loop, listening, address, pipe))
    _receive(page, loop)
    with contextlib.suppress(TimeoutError):
        loop.run(page.stop(), _STOP_TIMEOUT_S)
    os._exit(0)  # at once: nothing else needs a clean end


async def _serve(start: Start, loop: GraphLoop, listening: socket.socket, at: PageAddress, pipe: OwnerPipe) -> Page:
    """Serve the page and send its addresses to the owner."""
    port = int(listening.getsockname()[1])
    access = Access(
        host=at.host,
        port=port,
        allowed=at.allowed,
        needs_token=True,
        token=start.token,
        view_token=start.view_token,
    )
    page = Page(start, loop=loop, assets=Assets(os.environ, Path(os.fsdecode(start.source))), send=pipe.send)
    reachable = "127.0.0.1" if at.host in ("0.0.0.0", "") else at.host
    authority = f"[{reachable}]:{port}" if ":" in reachable else f"{reachable}:{port}"
    page.addresses = Served(
        url=access.url(reachable, port),
        foxglove_url=f"ws://{authority}/?token={access.token}",
        view_url=access.view_url(reachable, port),
        network_urls=tuple(access.base_url(address, port) for address in network_addresses(at.host)),
    )
    await HttpServer(page, access, ClientFiles()).start(listening)
    loop.spawn(page.run()).add_done_callback(_end)
    pipe.send(page.addresses)
    return page


def _end(run: "Future[None]") -> None:
    """End the process after a bug: its owner then stops driven robots."""
    if not run.cancelled():
        logging.getLogger(__name__).critical("the page has failed", exc_info=run.exception())
        os._exit(1)


def _receive(page: Page, loop: GraphLoop) -> None:
    """Receive the owner's messages until the pipe ends."""
    try:
        while True:
            message = to_server_decoder.decode(read_frame(sys.stdin.buffer))
            loop.call_soon(lambda message=message: page.receive_from_owner(message))
    except (EOFError, OSError):
        return


if __name__ == "__main__":
    main()

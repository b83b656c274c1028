"""Output of a node's terminal: its end for each new client, then new output."""

from collections.abc import Sequence

from ..clients.frames import Buffer
from .channels import StreamChannel
from .streams import TERMINAL, TERMINAL_HEADER


class TerminalChannel(StreamChannel):
    """Channel of one terminal; a slow client gets the end of the output once its queue is empty."""

    def __init__(self, topic: str) -> None:
        super().__init__(topic, encoding=TERMINAL.replace("/", ".").strip("."), period_s=0.0)

    def encode_change(self, message: bytes) -> Sequence[Buffer]:
        end = 0
        if self._newest:
            end = TERMINAL_HEADER.unpack_from(self._newest)[0] + len(self._newest) - TERMINAL_HEADER.size
        whole = super().encode_change(message)
        first, columns, rows = TERMINAL_HEADER.unpack_from(message)
        sent = end - first
        if not 0 < sent <= len(message) - TERMINAL_HEADER.size:
            return whole
        return (TERMINAL_HEADER.pack(end, columns, rows), memoryview(message)[TERMINAL_HEADER.size + sent :])

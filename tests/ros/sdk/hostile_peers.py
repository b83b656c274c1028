"""Peers of a node that send headers and requests of random bytes, with lengths that lie."""

import random
import socket
import struct
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress

_MUTATIONS = 40
_LISTENING = """
import psutil, sys
for connection in psutil.Process(int(sys.argv[1])).net_connections(sys.argv[2]):
    if connection.status in ("LISTEN", "NONE"):
        print(connection.laddr.port)
"""


def listening_ports(pid: int, kind: str = "tcp") -> list[int]:
    """Return the ports at which a node listens: those of XML-RPC and TCPROS, or with "udp" those of UDPROS."""
    command = [sys.executable, "-c", _LISTENING, str(pid), kind]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return [int(word) for word in done.stdout.split()]


def request(body: bytes) -> bytes:
    """Return an XML-RPC request with a body."""
    return b"POST / HTTP/1.1\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n%s" % (len(body), body)


def attack(pid: int) -> None:
    """Send hostile headers and requests to each port of a node."""
    ports = listening_ports(pid)
    assert len(ports) == 2, "XML-RPC and TCPROS"
    for port in ports:
        for sent in _attacks():
            with socket.create_connection(("127.0.0.1", port)) as peer:
                peer.settimeout(0.05)
                with suppress(OSError):
                    peer.sendall(sent)
                    while peer.recv(4096):
                        pass


def _attacks() -> Iterator[bytes]:
    rng = random.Random(3)
    header = _header(b"service=/add_two_ints", b"md5sum=*", b"callerid=/x", b"persistent=1")
    calls = [
        _call("publisherUpdate", "/x", "/chatter", ["http://127.0.0.1:9/"]),
        _call("requestTopic", "/x", "/chatter", [["TCPROS"]]),
        _call("paramUpdate", "/x", "/greeting", "a&lt;b"),
        _call("getBusInfo", "/x"),
    ]
    for size in (0, 1, 4, 36, 2**31, 2**32 - 1):
        yield struct.pack("<I", size) + rng.randbytes(40)
    yield struct.pack("<I", 8) + struct.pack("<I", 2**32 - 1) + b"abcd"
    for size in (0, 3, 16, 999_999_999, 2**32 - 1):
        yield header + struct.pack("<I", size) + rng.randbytes(min(size, 64))
    yield b"POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n"
    yield b"POST / HTTP/1.1\r\nContent-Length: -5\r\n\r\n"
    for body in (b"", b"<", b"<value>" * 5000, rng.randbytes(500), _call("publisherUpdate"), _call("requestTopic", 9)):
        yield request(body)
    topic = _header(b"topic=/add_two_ints_server/ticks", b"md5sum=*", b"type=*", b"callerid=/x", b"tcp_nodelay=1")
    for _ in range(_MUTATIONS):
        yield request(_mutated(rng, rng.choice(calls)))
        yield _mutated(rng, rng.choice([header, topic, request(calls[0])]))


def _header(*fields: bytes) -> bytes:
    packed = b"".join(struct.pack("<I", len(field)) + field for field in fields)
    return struct.pack("<I", len(packed)) + packed


def _call(method: str, *arguments: object) -> bytes:
    params = "".join(f"<param>{_value(argument)}</param>" for argument in arguments)
    return f"<methodCall><methodName>{method}</methodName><params>{params}</params></methodCall>".encode()


def _value(value: object) -> str:
    if isinstance(value, list):
        return f"<value><array><data>{''.join(map(_value, value))}</data></array></value>"
    kind = "i4" if isinstance(value, int) else "string"
    return f"<value><{kind}>{value}</{kind}></value>"


def _mutated(rng: random.Random, data: bytes) -> bytes:
    """Return bytes of which some are replaced, left out or repeated."""
    parts = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(parts))
        end = min(len(parts), at + rng.randint(1, 12))
        parts[at:end] = rng.choice([rng.randbytes(end - at), b"", parts[at:end] * 3, b"<", b"\xff" * 4])
    return bytes(parts)

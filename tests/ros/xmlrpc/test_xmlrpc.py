"""XML-RPC text: values survive a round trip, and any input of a peer is read safely."""

import xmlrpc.client
from datetime import datetime
from typing import Any

import pytest

from trundle.ros.errors import WireError
from trundle.ros.xmlrpc.xmlrpc_text import (
    FaultError,
    decode_call,
    decode_response,
    encode_call,
    encode_fault,
    encode_response,
)

VALUES = [
    True,
    -7,
    2.5,
    1e-300,
    "",
    "a <b> & 'c' \n ü",
    b"\x00\xff",
    datetime(2026, 1, 2, 3, 4, 5),
    [],
    [1, [2, "x"]],
    {},
    {"a": {"b": [1.0]}},
]


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_values_survive_the_round_trip(value: object) -> None:
    assert decode_response(encode_response(value)) == value


@pytest.mark.parametrize("value", [v for v in VALUES if not isinstance(v, bytes | datetime)], ids=repr)
def test_calls_are_interchangeable_with_the_standard_library(value: Any) -> None:
    assert xmlrpc.client.loads(encode_call("m", [value])) == ((value,), "m")
    assert decode_call(xmlrpc.client.dumps((value,), "m").encode()) == ("m", [value])


def test_an_untyped_value_is_a_string() -> None:
    body = b"<?xml version='1.0'?><methodCall><methodName>m</methodName><params><param><value>/node</value></param>"
    assert decode_call(body + b"<param><value><i4>3</i4></value></param></params></methodCall>") == ("m", ["/node", 3])


def test_a_fault_is_raised_with_its_text() -> None:
    with pytest.raises(FaultError, match="no such method"):
        decode_response(encode_fault(1, "no such method"))


@pytest.mark.parametrize("value", [2**31, None, {1: 2}, object()], ids=["too large", "none", "key", "object"])
def test_values_that_xml_rpc_cannot_carry_are_refused(value: object) -> None:
    with pytest.raises(ValueError, match=r"XML-RPC|keys"):
        encode_response(value)


BOMB = b"""<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>
<methodCall><methodName>&b;</methodName></methodCall>"""


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"\x00\x01\x02",
        b"<methodCall>",
        b"<methodResponse/>",
        b"<methodCall><methodName>m</methodName><params><param><value><int>x</int></value></param></params></methodCall>",
        b"<methodCall><int>3</int></methodCall>",
        BOMB,
        BOMB.decode().replace('version="1.0"', 'version="1.0" encoding="UTF-16"').encode("utf-16"),
        b"<methodCall>" + b"<value><array><data>" * 5000,
        b"<methodCall><params><struct><member><value>1</value></member></struct></params></methodCall>",
        b"<methodCall><value><base64>!</base64></value></methodCall>",
    ],
    ids=range(11),
)
def test_invalid_calls_are_refused_with_one_exception(body: bytes) -> None:
    with pytest.raises(WireError):
        decode_call(body)


@pytest.mark.parametrize("code", ["<array><data/></array>", "abc", "<double>1e999</double>", "<nil/>"])
def test_a_fault_with_an_invalid_code_is_a_fault(code: str) -> None:
    member = f"<member><name>faultCode</name><value>{code}</value></member>"
    body = f"<methodResponse><fault><value><struct>{member}</struct></value></fault></methodResponse>"
    with pytest.raises(FaultError, match="fault 0"):
        decode_response(body.encode())

"""Clients that leave before their requests are answered."""

from urllib.parse import urlsplit

import pytest
from fuzz.connection import SEPARATOR, send_web_socket
from tests.graphs import running_graph
from tests.page_client import socket_url

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session


def test_a_client_that_leaves_during_a_request_causes_no_output(
    capfd: pytest.CaptureFixture[str],
) -> None:
    questions = SEPARATOR.join(
        (
            b'{"op": "setParameters", "parameters": [{"name": "/a", "value": 1}], "id": "x"}',
            b'{"op": "getParameters", "parameterNames": ["/a"], "id": "y"}',
            b'{"op": "subscribeParameterUpdates", "parameterNames": ["/a"]}',
        )
    )
    with (
        running_graph() as graph,
        PageServer.start(
            Session(title="t", kind="graph"),
            at=PageAddress(port=0),
            graph=GraphAddress(master_uri=graph.core.uri),
        ) as page,
    ):
        address = urlsplit(socket_url(page.url))
        assert address.port is not None
        capfd.readouterr()  # warnings about a slow start
        for _ in range(20):
            send_web_socket(address.port, f"/?{address.query}", "trundle.v1", questions)
        assert page.alive

    assert capfd.readouterr().err == ""

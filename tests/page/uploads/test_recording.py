"""Upload of a recording over HTTP: its owner compares with it, and it is removed afterwards."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from tests.graphs import until
from tests.page.uploads.test_uploads import post

from trundle.base.http.page_address import PageAddress
from trundle.page import Compare, PageServer, Session


def compared(page: PageServer, name: str, content: bytes, *, error: str | None = None) -> tuple[int, str, Compare]:
    """Upload a recording, answer as the owner and return the response and the request; the file has the content."""
    requests: list[Compare] = []

    def answer() -> bool:
        for request in page.requests():
            assert isinstance(request.action, Compare)
            assert Path(os.fsdecode(request.action.file)).read_bytes() == content
            requests.append(request.action)
            page.respond(request.id, error)
        return bool(requests)

    with ThreadPoolExecutor(1) as thread:
        posted = thread.submit(post, page.url, {name: content}, to="reference")
        until(lambda: answer() or posted.done())
        status, text = posted.result()
    assert requests, text
    return status, text, requests[0]


def test_an_uploaded_recording_is_compared_with(page: PageServer) -> None:
    status, text, request = compared(page, "drives/run.log", b"rows" * 200_000)

    assert (status, text, request.title) == (200, '{"title":"run.log"}', "run.log")
    assert not Path(os.fsdecode(request.file)).parent.exists()


def test_the_owners_refusal_is_the_answer(page: PageServer) -> None:
    status, text, request = compared(page, "run.log", b"", error="it was recorded in another world")

    assert (status, text) == (400, "it was recorded in another world")
    assert not Path(os.fsdecode(request.file)).exists()


@pytest.mark.parametrize(
    ("name", "title"),
    [
        ("../../etc/passwd", "passwd"),
        ("x" * 300, "x" * 100),
        ("drives/", "recording"),
        ("<b>&amp;", "<b>&amp;"),
    ],
)
def test_a_name_is_only_a_title(page: PageServer, name: str, title: str) -> None:
    _, _, request = compared(page, name, b"rows")

    assert request.title == title
    assert Path(os.fsdecode(request.file)).name == "recording"


def test_a_form_without_a_file_is_refused(page: PageServer) -> None:
    assert post(page.url, {}, to="reference") == (400, "no file was sent")
    assert page.requests() == []


def test_a_view_only_link_cannot_compare(page: PageServer) -> None:
    assert post(page.view_url, {"run.log": b"rows"}, to="reference") == (403, "this link is view-only")
    assert page.requests() == []


def test_a_page_without_a_world_compares_no_state_log() -> None:
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0)) as page:
        status, text = post(page.url, {"run.log": b"rows"}, to="reference")

    assert (status, text) == (400, "run.log: topics can only be compared with a bag")

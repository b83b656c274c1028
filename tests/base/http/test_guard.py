"""The guard of web servers: what it reads of requests, and its answers to those that are refused."""

import asyncio

import pytest
from aiohttp import web
from aiohttp.test_utils import make_mocked_request
from multidict import CIMultiDict

from trundle.base.http.access import Access
from trundle.base.http.guard import Guard

ACCESS = Access(host="127.0.0.1", port=8080, serves_local_pages=True)


def _refused(guard: Guard, *fields: tuple[str, str]) -> web.Response | None:
    headers = CIMultiDict([("Host", "localhost:8080"), *fields])
    return asyncio.run(guard.refuse(make_mocked_request("GET", "/stream", headers=headers)))


@pytest.mark.parametrize("field", [("Host", "evil.example"), ("Origin", "null")])
def test_a_duplicate_header_is_refused(field: tuple[str, str]) -> None:
    """A proxy may decide by one of them, and the server by the other."""
    answer = _refused(Guard(ACCESS), field, field)

    assert answer is not None
    assert (answer.status, answer.text) == (403, f"refused: duplicate header {field[0]}\n")


@pytest.mark.parametrize("site", ["same-site", "cross-site"])
def test_a_picture_in_another_sites_page_is_refused_by_the_page_alone(site: str) -> None:
    """web_video_server's streams are pictures of pages on other ports; browsers send no Origin for them."""
    fields = (("Sec-Fetch-Mode", "no-cors"), ("Sec-Fetch-Site", site))

    assert _refused(Guard(ACCESS), *fields) is None
    answer = _refused(Guard(ACCESS, is_page=True), *fields)
    assert answer is not None
    assert "does not answer other sites' pages" in str(answer.text)

"""Guard of web servers: the request fields that it reads, and its responses to refused requests."""

import asyncio

import pytest
from aiohttp import web
from aiohttp.test_utils import make_mocked_request
from multidict import CIMultiDict

from trundle.base.http.access import Access
from trundle.base.http.guard import Guard

ACCESS = Access(host="127.0.0.1", port=8080, serves_local_pages=True)


def _refusal(guard: Guard, *fields: tuple[str, str]) -> web.Response | None:
    headers = CIMultiDict([("Host", "localhost:8080"), *fields])
    return asyncio.run(guard.refuse(make_mocked_request("GET", "/stream", headers=headers)))


@pytest.mark.parametrize("field", [("Host", "evil.example"), ("Origin", "null")])
def test_a_duplicate_header_is_refused(field: tuple[str, str]) -> None:
    """A proxy may read one of them, and the server the other."""
    response = _refusal(Guard(ACCESS), field, field)

    assert response is not None
    assert (response.status, response.text) == (403, f"refused: duplicate header {field[0]}\n")


@pytest.mark.parametrize("site", ["same-site", "cross-site"])
def test_only_the_page_refuses_images_embedded_by_other_sites(site: str) -> None:
    """Pages on other ports embed web_video_server's streams as images; browsers send no Origin for them."""
    fields = (("Sec-Fetch-Mode", "no-cors"), ("Sec-Fetch-Site", site))

    assert _refusal(Guard(ACCESS), *fields) is None
    response = _refusal(Guard(ACCESS, is_page=True), *fields)
    assert response is not None
    assert "does not answer other sites' pages" in str(response.text)

"""Pictures of the owner's renderer, for browsers without WebGL."""

import threading
import time
import urllib.error
import urllib.request
from collections.abc import Callable

import pytest
from tests.page_client import page_url

from trundle.page import PageServer, RenderView, Request

PNG = b"\x89PNG picture"


def _fetch(url: str) -> tuple[int, bytes]:
    try:
        with urllib.request.urlopen(url, timeout=60) as answer:
            assert answer.headers["Content-Type"] == "image/png"
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read()


def _answered(page: PageServer, query: str, answer: Callable[[Request], None]) -> tuple[int, bytes]:
    """Fetch a picture while the owner answers."""
    results: list[tuple[int, bytes]] = []
    thread = threading.Thread(target=lambda: results.append(_fetch(page_url(page.url, f"/camera.png?{query}"))))
    thread.start()
    while thread.is_alive():
        for request in page.requests():
            answer(request)
        time.sleep(0.005)
    return results[0]


def test_the_owner_draws_the_requested_view(page: PageServer) -> None:
    views: list[object] = []

    def draw(request: Request) -> None:
        views.append(request.action)
        page.respond_picture(request.id, PNG)

    query = "width=640&height=480&azimuth=0.5&elevation=-0.25&distance=2&t=123.5"
    assert _answered(page, query, draw) == (200, PNG)
    assert views == [RenderView(width=640, height=480, azimuth=0.5, elevation=-0.25, distance=2.0)]


def test_a_failed_picture_has_a_reason(page: PageServer) -> None:
    answer = _answered(page, "width=64&height=48", lambda request: page.respond(request.id, "no\nrenderer here"))

    assert answer == (503, b"no renderer here\n")


@pytest.mark.parametrize(
    "query",
    [
        "",
        "width=64",
        "width=0&height=48",
        "width=64&height=99999",
        "width=64&height=48&distance=nan",
        "width=x&height=1",
    ],
)
def test_an_invalid_view_is_refused(page: PageServer, query: str) -> None:
    status, reason = _fetch(page_url(page.url, f"/camera.png?{query}"))

    assert status == 400
    assert reason.startswith(b"not a view")
    assert page.requests() == []


def test_further_pictures_wait_for_a_slot(page: PageServer) -> None:
    """Four are drawn at the same time."""
    results: list[tuple[int, bytes]] = []
    url = page_url(page.url, "/camera.png?width=64&height=48")
    threads = [threading.Thread(target=lambda: results.append(_fetch(url))) for _ in range(7)]
    for thread in threads:
        thread.start()
    waiting: list[Request] = []
    while len(waiting) < 4:
        waiting += page.requests()
        time.sleep(0.005)
    for number in range(7):
        assert len(waiting) - number <= 4
        page.respond_picture(waiting[number].id, PNG)
        while len(waiting) < min(7, number + 5):
            waiting += page.requests()
            time.sleep(0.005)
    for thread in threads:
        thread.join()
    assert results == [(200, PNG)] * 7

"""A user with a slow connection, or a browser that is busy most of the time: the page stays up to date, or says so."""

import statistics
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.system.browser import opened, until
from tests.throttled_link import ThrottledLink

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = needs_client

FAST, SLOW, STALLED = 50e6, 100e3, 2e3
"""Rates of connections [bytes/s]."""
PERIOD_S = 1 / 30
HOOK = """
window.ages = []; // time of handling and age of each message of a channel [ms]
const onmessage = Object.getOwnPropertyDescriptor(Worker.prototype, "onmessage");
Object.defineProperty(Worker.prototype, "onmessage", {
  set(handle) {
    onmessage.set.call(this, (event) => {
      const frame = event.data?.frame;
      if (frame instanceof ArrayBuffer && new Uint8Array(frame)[0] === 0x81 && frame.byteLength < 1000) {
        const sent = Number(new DataView(frame).getBigUint64(13, true) / 1000000n);
        window.ages.push([performance.now(), Date.now() - sent]);
      }
      handle.call(this, event);
    });
  },
  get() { return onmessage.get.call(this); },
});
"""
BUSY = """
setInterval(() => {
  const end = performance.now() + 450;
  while (performance.now() < end);
}, 500);
"""


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@contextmanager
def _publishing(graph: Graph) -> Iterator[None]:
    """Publish transforms, a number and images, 7 MB/s."""
    node = graph.node("robot")
    frames = node.advertise("/tf", "tf2_msgs/TFMessage")
    speed = node.advertise("/speed", "std_msgs/Float64")
    camera = node.advertise("/camera", "sensor_msgs/Image")
    pixels = np.zeros(320 * 240 * 3, np.uint8)
    transform = {"header": {"frame_id": "odom"}, "child_frame_id": "base", "transform": {"rotation": {"w": 1.0}}}
    ended = threading.Event()

    def publish() -> None:
        while not ended.wait(PERIOD_S):
            frames.publish({"transforms": [transform]})
            speed.publish({"data": time.monotonic()})
            camera.publish({"height": 240, "width": 320, "encoding": "rgb8", "step": 960, "data": pixels})

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        for publisher in (frames, speed, camera):
            publisher.unregister()


@contextmanager
def _open_page(chromium: Any, graph: Graph) -> Iterator[tuple[Any, ThrottledLink]]:
    """Open a page that shows an image and plots a number, over a link that is fast at first."""
    session = Session(title="slow", kind="graph", images=("/camera",), plots=("/speed/data",))
    address = GraphAddress(master_uri=graph.core.uri)
    with (
        PageServer.start(session, at=PageAddress(port=0), graph=address) as server,
        ThrottledLink(server.url, bytes_per_s=FAST, buffer_bytes=4 * 1024 * 1024) as link,
        opened(chromium, "about:blank") as page,
        _publishing(graph),
    ):
        page.add_init_script(HOOK)
        page.goto(link.url)
        page.get_by_label("Connected").first.wait_for()
        until(page, lambda: page.evaluate("window.ages.length") > 50, "messages")
        yield page, link


def _ages_ms(page: Any, duration_ms: int) -> Any:
    """Collect pairs of a message's time of handling and age."""
    page.evaluate("window.ages = []")
    page.wait_for_timeout(duration_ms)
    return page.evaluate("window.ages")


def _usual_age_ms(page: Any) -> float:
    """Return the median age on this machine, with whatever else it does."""
    return statistics.median(age for _, age in _ages_ms(page, 5_000))


def _seconds_behind(chip: Any) -> float:
    return float(chip.inner_text().partition(" s behind")[0])


@pytest.mark.slow
def test_a_late_page_says_so_until_it_has_caught_up(chromium: Any, graph: Graph) -> None:
    with _open_page(chromium, graph) as (page, link):
        chip = page.locator(".connection")
        assert "behind" not in chip.inner_text()

        link.bytes_per_s = STALLED
        chip.get_by_text("s behind").wait_for()
        assert "Late since" in chip.get_attribute("data-tip")
        seconds = _seconds_behind(chip)
        until(page, lambda: _seconds_behind(chip) > seconds, "a greater lag")

        link.bytes_per_s = FAST
        chip.get_by_text("s behind").wait_for(state="detached")
        chip.get_by_text("Connected").wait_for()


@pytest.mark.slow
def test_a_page_behind_a_slow_connection_stays_up_to_date(chromium: Any, graph: Graph) -> None:
    """Images need seventy times as much as the connection has."""
    with _open_page(chromium, graph) as (page, link):
        usual = _usual_age_ms(page)
        link.bytes_per_s = SLOW
        page.wait_for_timeout(10_000)
        ages = [age for _, age in _ages_ms(page, 10_000)]

    assert len(ages) > 2 * 10 / PERIOD_S / 4
    assert statistics.median(ages) < usual + 300


@pytest.mark.slow
def test_a_busy_browser_shows_what_is_new_between_its_frames(chromium: Any, graph: Graph) -> None:
    """Two frames a second: each begins with fresh messages."""
    with _open_page(chromium, graph) as (page, _):
        usual = _usual_age_ms(page)
        page.evaluate(BUSY)
        page.wait_for_timeout(3000)
        ages = _ages_ms(page, 10_000)

    newest = {int(handled / 500): age for handled, age in ages}
    assert len(newest) > 5
    assert statistics.median(newest.values()) < usual + 300

"""A busy page in Chromium that draws on the CPU: script time of the page's main thread per frame, from its trace.

A cloud of a million points at 5 Hz, the Topics panel with 100 topics at 10 Hz, and a world of 200 moving models.
"""

import json
import tempfile
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np

from bench.chromium import chromium, is_installed
from bench.page import process
from bench.page_pointer import many_models
from bench.running_page import running_page
from bench.table import Row
from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, RvizFile, Session
from trundle.ros import Core, GraphLoop

_PATIENCE_MS = 120_000
_VIEWPORT = {"width": 1024, "height": 640}
"""The page's script per frame depends on what is shown, not on its pixels, which the CPU draws beside it."""
_TRACED_MS = 5000
_POINTS, _CLOUDS_HZ = 1_000_000, 5.0
_TOPICS, _TOPICS_HZ = 100, 10.0
_SCRIPTS = ("FireAnimationFrame", "FunctionCall", "TimerFire", "EventDispatch", "v8.callFunction", "RunMicrotasks")
_CLOUD_DISPLAY = {"Class": "rviz/PointCloud2", "Name": "Cloud", "Enabled": True, "Topic": "/cloud", "Queue Size": 10}


def run() -> list[Row]:
    """Measure in one browser."""
    if not is_installed():
        return []
    with chromium() as browser:
        found = measure(browser)
    return [Row(f"{name}: script per frame", milliseconds, "ms", "", None) for name, milliseconds in found.items()]


def measure(browser: Any) -> dict[str, float]:
    """Return what is shown → script time per frame [ms]."""
    with _graph_page(_publish_clouds, _CLOUD_DISPLAY) as url:
        cloud = _script_ms(
            browser, url, lambda page: page.get_by_role("treeitem").filter(has_text="Cloud").first.wait_for()
        )
    with _graph_page(_publish_topics) as url:
        topics = _script_ms(browser, url, _open_topics)
    with _moving_world() as url:
        models = _script_ms(browser, url, _play)
    return {"cloud of 10⁶ points at 5 Hz": cloud, "100 topics": topics, "200 moving models": models}


def _open_topics(page: Any) -> None:
    page.locator(".dv-tab", has_text="Topics").click()
    page.get_by_role("button", name="/topic_0", exact=True).first.wait_for()


def _play(page: Any) -> None:
    """Start the simulation once the world is loaded, so that both do not wait for each other."""
    page.locator(".scene-note").wait_for(state="detached")
    page.get_by_role("button", name="Play").click()


def _script_ms(browser: Any, url: str, prepare: Callable[[Any], None]) -> float:
    """Return the main thread's script time per drawn frame [ms] of a page that is ready after `prepare`."""
    page = browser.new_page(viewport=_VIEWPORT)
    page.set_default_timeout(_PATIENCE_MS)
    page.goto(url)
    page.get_by_label("Connected").first.wait_for()
    prepare(page)
    page.wait_for_timeout(2000)
    browser.start_tracing(page=page, categories=["devtools.timeline", "v8"])
    page.wait_for_timeout(_TRACED_MS)
    events = json.loads(browser.stop_tracing())["traceEvents"]
    page.close()
    frames = [event for event in events if event.get("name") == "FireAnimationFrame"]
    assert frames, "the page drew nothing"
    main = (frames[0]["pid"], frames[0]["tid"])
    scripts = [event for event in events if event.get("name") in _SCRIPTS and (event["pid"], event["tid"]) == main]
    return _outermost_us(scripts) / len(frames) / 1e3


def _outermost_us(events: list[Any]) -> float:
    """Return the thread time of a thread's events [µs], those inside others left out."""
    total, end = 0.0, 0.0
    for event in sorted(events, key=lambda event: event["ts"]):
        if event["ts"] >= end:
            total += float(event.get("tdur", event.get("dur", 0)))
            end = event["ts"] + event.get("dur", 0)
    return total


@contextmanager
def _graph_page(publish: Callable[[Connection, str], None], *displays: dict[str, Any]) -> Generator[str]:
    """Serve the page of a graph to which a process publishes; yield its address."""
    content = {"Displays": displays, "Global Options": {"Fixed Frame": "map"}}
    rviz = RvizFile(name="b.rviz", text=json.dumps({"Visualization Manager": content}), writable=False)
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        with process(publish, core.uri) as publisher:
            session = Session(title="b", kind="graph", rviz=rviz)
            address = GraphAddress(master_uri=core.uri)
            with PageServer.start(session, at=PageAddress(port=0), graph=address) as page:
                publisher.send("go")
                yield page.url
        loop.run(core.stop())


@contextmanager
def _moving_world() -> Generator[str]:
    """Simulate 200 models that rise slowly; yield the page's address."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "many.sdf")
        file.write_text(many_models("<gravity>0 0 0.01</gravity>"))
        with running_page(str(file), "--pause") as url:
            yield url


def _publish_clouds(pipe: Connection, master_uri: str) -> None:
    """Publish clouds of a cube's points after "go"."""
    from trundle.ros import Node

    points = np.zeros((_POINTS, 4), np.float32)
    points[:, :3] = np.random.default_rng(0).uniform(-2.0, 2.0, (_POINTS, 3))
    fields = [{"name": name, "offset": 4 * at, "datatype": 7, "count": 1} for at, name in enumerate("xyz")]
    with GraphLoop() as loop:
        node = Node("clouds", loop=loop, master_uri=master_uri)
        publisher = node.advertise("/cloud", "sensor_msgs/PointCloud2", queue_size=1)
        content = {"header": {"frame_id": "map"}, "width": _POINTS, "height": 1, "point_step": 16, "fields": fields}
        content |= {"row_step": 16 * _POINTS, "is_dense": True, "data": points.reshape(-1).view(np.uint8)}
        cloud = node.new("sensor_msgs/PointCloud2", content)
        pipe.recv()
        while True:
            publisher.publish(cloud)
            time.sleep(1 / _CLOUDS_HZ)


def _publish_topics(pipe: Connection, master_uri: str) -> None:
    """Publish numbers on all topics after "go"."""
    from trundle.ros import Node

    with GraphLoop() as loop:
        node = Node("numbers", loop=loop, master_uri=master_uri)
        publishers = [node.advertise(f"/topic_{at}", "std_msgs/Float64") for at in range(_TOPICS)]
        pipe.recv()
        for count in range(10**9):
            for publisher in publishers:
                publisher.publish({"data": float(count)})
            time.sleep(1 / _TOPICS_HZ)

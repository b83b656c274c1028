"""A page that plays a bag beside another one: the recording's samples and the differences that clients get."""

import json
import os
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.page_client import ProtocolClient, page_url
from tests.recorded_drives import write_drive

from trundle.base.http.page_address import PageAddress
from trundle.page import BagFile, BagReferenceFile, PageServer, Session
from trundle.page.bag.reference_samples import reference_samples
from trundle.ros import open_bag, read_numbers

REFERENCE, DIFFERENCES = "trundle/reference", "trundle/differences"


def test_poses_of_frames_are_composed_to_their_root(tmp_path: Path) -> None:
    with open_bag(write_drive(tmp_path / "a.bag", speed=0.5, seconds=2.0)) as bag:
        samples = reference_samples(read_numbers(bag))

    assert (samples.root, sorted(samples.frames)) == ("odom", ["base_link", "laser"])
    times = np.frombuffer(samples.data, "<f8", samples.samples)
    poses = np.frombuffer(samples.data, "<f4")[-7 * 2 * samples.samples :].reshape(samples.samples, 2, 7)
    laser = poses[:, samples.frames.index("laser")]
    assert laser[:, 0] == pytest.approx(0.5 * times, abs=1e-5)
    assert laser[-1].tolist() == pytest.approx([1.0, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0])
    odometry = next(topic for topic in samples.topics if topic.topic == "/odom")
    assert (odometry.samples, ".twist.twist.linear.x" in odometry.paths) == (41, True)
    assert ".position[left]" in next(topic for topic in samples.topics if topic.topic == "/joint_states").paths


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Page that plays 0.5 m/s flat out beside 0.4 m/s."""
    folder = tmp_path_factory.mktemp("bags")
    one = write_drive(folder / "a.bag", speed=0.5)
    other = write_drive(folder / "b.mcap", speed=0.4, start_s=2000.0)
    playing = BagFile(path=os.fsencode(one), speed=2.0, paused=False)
    session = Session(title="a.bag", kind="bag")
    with PageServer.start(session, at=PageAddress(port=0), bag=playing, reference=BagReferenceFile.of(other)) as server:
        yield server.url


def until_content(client: ProtocolClient, topic: str, condition: Callable[[Any], bool]) -> Any:
    """Wait for a message of a JSON channel that fulfills a condition."""
    seen: list[Any] = []

    def found() -> bool:
        seen[:] = map(json.loads, client.payloads(topic))
        return bool(seen) and condition(seen[-1])

    client.until(found)
    return seen[-1]


def test_clients_get_the_recording_and_the_differences_so_far(page: str) -> None:
    with ProtocolClient(page) as client:
        client.subscribe(REFERENCE)
        info = until_content(client, REFERENCE, lambda found: found is not None)
        assert (info["start"], info["duration"], info["root"]) == (100.0, 4.0, "odom")
        with urllib.request.urlopen(page_url(page, info["url"])) as answer:
            assert len(answer.read()) > 8 * info["samples"]
        client.subscribe(DIFFERENCES)
        found = until_content(client, DIFFERENCES, lambda found: found["time"] > 102.0)
    names = {row["name"]: row for row in found["rows"] if row["quantity"] != "angle"}
    since = found["time"] - 100.0
    assert names["base_link in odom"]["now"] == pytest.approx(0.1 * since, abs=0.02)
    assert names["/odom.twist.twist.linear.x"]["maximum"] == pytest.approx(0.1)
    assert names["/joint_states.position[left]"]["now"] == pytest.approx(since, abs=0.2)

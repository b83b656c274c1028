"""Lanes of a bag: the intervals with messages of each topic, from the index."""

import json
from pathlib import Path

import pytest
from tests.page.bag.test_source import (
    START,
    TEXT,
    S,
    bag as bag,  # both formats
    client as client,
    connection,
    text,
)
from tests.page_client import ProtocolClient

from trundle.page.bag.lanes import Lane, read_lanes
from trundle.ros import BagMessage, create_bag


def test_a_client_gets_a_lane_for_each_topic(client: ProtocolClient) -> None:
    """Ten seconds are 600 buckets: ten messages a second are separate bands, the latched map is one band."""
    client.subscribe("trundle/lanes")
    client.until(lambda: client.payloads("trundle/lanes"))

    lanes = json.loads(client.payloads("trundle/lanes")[-1])
    assert lanes["start_ns"] == START
    assert 600 * lanes["bucket_ns"] == pytest.approx(10 * S, rel=1e-3)
    assert lanes["topics"]["/map"] == {"count": 1, "bands": [[0, 0]]}
    assert lanes["topics"]["/rare"] == {"count": 1, "bands": [[29, 29]]}
    assert lanes["topics"]["/text"]["count"] == 101
    assert [first for first, _ in lanes["topics"]["/text"]["bands"][:4]] == pytest.approx([0, 6, 12, 18], abs=1)


def test_a_later_client_gets_the_lanes_too(client: ProtocolClient) -> None:
    for _ in range(2):
        number = client.subscribe("trundle/lanes")
        client.messages.clear()
        client.until(lambda: client.payloads("trundle/lanes"))
        client.unsubscribe(number)


@pytest.mark.parametrize("suffix", ["bag", "mcap"])
def test_adjacent_buckets_form_one_band(tmp_path: Path, suffix: str) -> None:
    """200 Hz for a second, nothing for eight, 200 Hz for a second."""
    path = tmp_path / f"gap.{suffix}"
    with create_bag(path) as writer:
        for tick in (*range(200), *range(1800, 2000)):
            writer.write(BagMessage(TEXT, START + tick * S // 200, text("x")))
        writer.write(BagMessage(connection("/end", "std_msgs/String"), START + 10 * S, text("x")))

    lanes = read_lanes(path).topics

    assert lanes == {"/text": Lane(400, [(0, 59), (539, 599)]), "/end": Lane(1, [(599, 599)])}


def test_a_damaged_bag_has_no_lanes(tmp_path: Path) -> None:
    path = tmp_path / "cut.bag"
    path.write_bytes(b"#ROSBAG V2.0\n")

    assert read_lanes(path).topics == {}

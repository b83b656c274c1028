"""Rows of worlds with topics in their measures, and bags of the runs that are not ok."""

from collections import Counter
from pathlib import Path

import pytest

import trundle
from trundle.base.diagnostics import TrundleError
from trundle.ros import open_bag
from trundle.studies.sweep.plan_reader import load_plan
from trundle.studies.sweep.row_runner import RowRunner
from trundle.studies.sweep.rows import Rows

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
WORLD = """<sdf version="1.6"><world name="w">
<model name="box"><pose>0 0 10 0 0 0</pose><link name="link"><inertial><mass>1</mass></inertial>
<sensor name="eye" type="camera"><update_rate>20</update_rate><always_on>1</always_on><topic>eye</topic>
<camera><image><width>8</width><height>6</height></image></camera></sensor>
<sensor name="imu" type="imu"><update_rate>50</update_rate><always_on>1</always_on><topic>imu</topic></sensor></link>
</model></world></sdf>"""
PLAN = """\
world: box.sdf
duration: 1
seed: 3
bag: 0.25
vary: {gravity/z: [-9.8, -3]}
measure:
  felt: topics["/imu"].linear_acceleration.z
  highest: {max: 'topics["/imu"].header.stamp.nanosec'}
  silent: {max: 'topics["/nobody"].data'}
  z: models.box.z
pass: [z > 6]
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    (tmp_path / "box.sdf").write_text(WORLD)
    (tmp_path / "plan.yaml").write_text(PLAN)
    return tmp_path / "plan.yaml"


def test_topics_are_measured_and_the_bag_holds_the_last_seconds(plan: Path) -> None:
    read = load_plan(plan)
    rows, runner = Rows(read), RowRunner(read)

    falls, floats = (runner.run(row) for row in rows)

    assert (falls.status, floats.status) == ("failed", "ok"), (falls.reason, floats.reason)
    assert falls.reason == f"not z > 6: z = {falls.measures['z']:.6g}"
    for result in (falls, floats):
        assert result.measures["silent"] is None
        assert result.measures["felt"] == pytest.approx(0, abs=1e-9), "free fall"
        assert result.measures["highest"] == 900_000_000
    bags = [runner.bag(rows.row(0), falls) for _ in range(2)]
    assert bags[0] is not None
    assert bags[0] == bags[1]
    file = plan.with_name("last.bag")
    file.write_bytes(bags[0])
    with open_bag(file) as bag:
        stamps = [message.stamp_ns for message in bag.messages() if message.connection.topic == "/imu"]
    assert len(stamps) == 13
    assert min(stamps) >= 750_000_000


@pytest.mark.slow
def test_a_sweep_keeps_the_bags_of_runs_that_are_not_ok(plan: Path) -> None:
    done = trundle.sweep(plan, workers=1)

    assert done.counts == {"failed": 1, "ok": 1}
    (bag,) = (done.folder / "bags").iterdir()
    assert bag.name == "row_0.bag"
    with open_bag(bag) as opened:
        assert {message.connection.topic for message in opened.messages()} >= {"/imu", "/clock"}


def test_a_message_has_the_fields_of_its_type(plan: Path) -> None:
    plan.write_text(PLAN.replace("linear_acceleration.z", "linear.z"))
    read = load_plan(plan)

    result = RowRunner(read).run(Rows(read).row(0))

    assert result.status == "error"
    assert "the message has no 'linear'; it has: header, orientation, " in result.reason


def test_a_world_has_no_parameters(plan: Path) -> None:
    plan.write_text(PLAN.replace("gravity/z", "parameters/gain"))
    with pytest.raises(TrundleError, match="a world has no ROS parameters; a `launch:` has"):
        trundle.sweep(plan)


@pytest.mark.parametrize(("bag", "has_pictures"), [("0.25", False), ("{last: 0.25, pictures: true}", True)])
def test_a_bag_has_pictures_only_where_they_are_asked_for(plan: Path, bag: str, has_pictures: bool) -> None:
    plan.write_text(PLAN.replace("bag: 0.25", f"bag: {bag}"))
    read = load_plan(plan)
    row, runner = Rows(read).row(0), RowRunner(read)

    content = runner.bag(row, runner.run(row))

    assert content is not None
    plan.with_name("last.bag").write_bytes(content)
    with open_bag(plan.with_name("last.bag")) as opened:
        counts = Counter(message.connection.type for message in opened.messages())
    assert counts["sensor_msgs/Imu"] == 13
    assert "sensor_msgs/CameraInfo" in counts
    assert ("sensor_msgs/Image" in counts) == has_pictures

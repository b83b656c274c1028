"""`trundle compare` of bags: topics, counts, rates, numbers, frames, and its exit code."""

import csv
import io
import subprocess
import sys
from pathlib import Path

import pytest
from tests.recorded_drives import write_drive

from trundle.app.cli import main


@pytest.mark.parametrize("suffix", ["bag", "mcap"])
def test_numbers_and_frames_are_compared_at_the_same_time_since_the_start(
    tmp_path: Path, suffix: str, capsys: pytest.CaptureFixture[str]
) -> None:
    one = write_drive(tmp_path / f"a.{suffix}", speed=0.5, start_s=100.0)
    other = write_drive(tmp_path / f"b.{suffix}", speed=0.4, start_s=2000.0, seconds=2.0)

    assert main(("compare", str(one), str(other), "--csv")) == 0

    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(capsys.readouterr().out)) if row[1] != "angle"}
    assert float(rows["base_link in odom"][1]) == pytest.approx(0.2), "0.1 m/s for the 2 s that both have"
    assert float(rows["base_link in odom"][2]) == pytest.approx(2.0)
    assert float(rows["/odom.pose.pose.position.x"][1]) == pytest.approx(0.2)
    assert [float(cell) for cell in rows["/odom.twist.twist.linear.x"][1:]] == pytest.approx([0.1, 0.0, 0.1, 0.1])
    assert float(rows["/joint_states.position[left]"][1]) == pytest.approx(2.0)
    scans = [name for name in rows if name.startswith("/scan.ranges")]
    assert len(scans) == 1, "one row of a long array"
    assert float(rows[scans[0]][1]) == pytest.approx(0.2, rel=1e-5)
    assert not {"laser in base_link", "/odom.pose.covariance[0]", "/scan.range_max"} & set(rows), "what rests"


def test_topics_are_listed_with_counts_and_rates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one = write_drive(tmp_path / "a.bag", speed=0.5, extra="std_msgs/String", kind="std_msgs/Float64")
    other = write_drive(tmp_path / "b.bag", speed=0.5, seconds=2.0, kind="std_msgs/Int32")

    assert main(("compare", str(one), str(other), "--tolerance", "1e-6")) == 1

    printed = capsys.readouterr()
    assert printed.err == "only in a.bag: /extra\n"
    words = {line.split()[0]: line.split() for line in printed.out.splitlines() if line.startswith("/")}
    assert words["/odom"] == ["/odom", "nav_msgs/Odometry", "81", "41", "20.0", "20.0"]
    assert words["/scan"] == ["/scan", "sensor_msgs/LaserScan", "41", "21", "10.0", "10.0"]
    assert "/kind is a std_msgs/Float64 in a.bag, a std_msgs/Int32 in b.bag\n" in printed.out
    assert "2.00 s, which both have, are compared" in printed.out


def test_the_time_is_told_from_which_on_poses_are_apart(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one = write_drive(tmp_path / "a.bag", speed=0.5, turn_s=1.0)
    other = write_drive(tmp_path / "b.bag", speed=0.5)

    assert main(("compare", str(one), str(other), "--tolerance", "0.3")) == 1

    printed = capsys.readouterr()
    assert "poses are apart by more than 0.3 m or rad from 1.10 s on: /joint_states\n" in printed.out
    assert printed.err == "1 of 3 differences exceed 0.3\n"


def test_equal_bags_do_not_differ(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, other = (write_drive(tmp_path / name, speed=0.5) for name in ("a.bag", "b.mcap"))

    assert main(("compare", str(one), str(other), "--tolerance", "0")) == 0

    printed = capsys.readouterr()
    assert "apart" not in printed.out
    assert "\n33 other numbers change and are equal\n" in printed.out, "1 of odom, 2 of joints, 30 of the scan"
    assert printed.err == ""


def test_what_cannot_be_compared_is_told_in_a_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = write_drive(tmp_path / "a.bag", speed=0.5)
    (tmp_path / "cut.bag").write_bytes(bag.read_bytes()[:3000])
    (tmp_path / "run.log").write_text("hello\n")
    sentences = {
        "cut.bag": "bag unindexed",
        "run.log": "run.log is none: compare two bags, or two state logs",
        "missing.bag": "No such file or directory",
    }

    for name, sentence in sentences.items():
        for words in ((str(bag), str(tmp_path / name)), (str(tmp_path / name), str(bag))):
            assert main(("compare", *words)) == 1
            printed = capsys.readouterr().err
            assert sentence in printed
            assert "Traceback" not in printed


def test_hostile_messages_are_left_out(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A type that contains itself, messages of too few bytes, and names with control characters."""
    from trundle.ros import BagConnection, BagMessage, create_bag

    def write(file: Path) -> Path:
        endless = BagConnection(topic="/e", type="a/A", md5sum="0" * 32, definition="a/A inner\nfloat64 x")
        short = BagConnection(topic="/s", type="a/B", md5sum="1" * 32, definition="float64 x")
        named = BagConnection(topic="/n", type="a/C", md5sum="2" * 32, definition="string[] name\nfloat64[] x")
        with create_bag(file) as bag:
            for stamp_ns in (1, 2):
                bag.write(BagMessage(endless, stamp_ns, b"\0" * 8))
                bag.write(BagMessage(short, stamp_ns, b"\0"))
                text = b"\x01\0\0\0\x02\0\0\0\x1b[\x01\0\0\0" + bytes(7) + bytes([0x40 if file.stem == "a" else 0x3F])
                bag.write(BagMessage(named, stamp_ns, text))
        return file

    one, other = write(tmp_path / "a.bag"), write(tmp_path / "b.bag")

    assert main(("compare", str(one), str(other), "--tolerance", "1")) == 1

    printed = capsys.readouterr()
    assert "/s of a.bag is not compared: 1 bytes are not a a/B" in printed.out
    assert "/e of b.bag is not compared" in printed.out
    assert "\x1b" not in printed.out + printed.err
    assert "differences exceed 1" in printed.err


def test_comparing_bags_loads_no_physics(tmp_path: Path) -> None:
    words = [str(write_drive(tmp_path / name, speed=0.1, seconds=0.5)) for name in ("a.bag", "b.bag")]
    code = "import sys; from trundle.app.cli import main; main(); "
    code += "print(*sorted({'mujoco', 'lxml', 'aiohttp'} & set(sys.modules)), file=sys.stderr)"

    done = subprocess.run([sys.executable, "-c", code, "compare", *words], capture_output=True, text=True, check=True)

    assert "base_link in odom" in done.stdout
    assert done.stderr.strip() == ""

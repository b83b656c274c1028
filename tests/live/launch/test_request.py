"""Arguments of `trundle launch`: files, packages, pipes."""

import os
import sys
from pathlib import Path

import pytest

from trundle.base.diagnostics import UsageError
from trundle.live.launch.request import read_request
from trundle.robots.packages import Packages


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace of one package with a launch file."""
    arm = tmp_path / "ws/src/robots/arm"
    arm.mkdir(parents=True)
    (arm / "package.xml").write_text("<package><name>arm</name></package>")
    (arm / "arm.launch").write_text("<launch/>")
    return tmp_path / "ws"


def test_the_used_workspace_is_printed(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    request = read_request(["arm", "arm.launch"], Packages({"HOME": "/nobody"}, start=workspace))

    assert request.files == (workspace / "src/robots/arm/arm.launch",)
    assert capsys.readouterr().err == f"using the workspace {workspace}\n"


def test_ros_package_path_comes_first_and_prints_nothing(
    workspace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other/arm"
    other.mkdir(parents=True)
    (other / "package.xml").write_text("<package><name>arm</name></package>")
    (other / "arm.launch").write_text("<launch/>")
    sourced = f"{tmp_path / 'other'}:{workspace / 'src'}"

    request = read_request(["arm", "arm.launch"], Packages({"ROS_PACKAGE_PATH": sourced}, start=workspace))

    assert request.files == (other / "arm.launch",)
    assert capsys.readouterr().err == ""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no /dev/fd")
def test_a_pipe_is_read_like_standard_input(tmp_path: Path) -> None:
    """`trundle launch <(sed … robot.launch)`."""
    reader, writer = os.pipe()
    os.write(writer, b"<launch/>")
    os.close(writer)
    (tmp_path / "b.launch").write_text("<launch/>")

    request = read_request([f"/dev/fd/{reader}", str(tmp_path / "b.launch")], Packages({}, start=tmp_path))

    assert (request.files, request.texts) == ((tmp_path / "b.launch",), (("<pipe>", "<launch/>"),))
    os.close(reader)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no FIFOs")
def test_a_pipe_that_nothing_writes_to_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.base.files._TIMEOUT_S", 0.01)
    os.mkfifo(tmp_path / "a.launch")

    with pytest.raises(UsageError, match=r"a\.launch: no end of the stream within 0\.01 s"):
        read_request([str(tmp_path / "a.launch")], Packages({}, start=tmp_path))

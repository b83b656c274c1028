"""Pipes, devices and impossible names in place of files: one error, and reading goes on."""

import os
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import expand_xacro, load, load_text
from trundle.robots.packages import Packages, model_file

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no FIFOs")

SDF = "<sdf version='1.6'>\n{}</sdf>"
LINK = "<model name='m'><link name='l'><visual name='v'>\n{}</visual></link></model>"
BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
XACRO = "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='base'/>{}</robot>"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A package with a pipe in it that has no writer."""
    (tmp_path / "package.xml").write_text("<package><name>arm</name></package>")
    os.mkfifo(tmp_path / "pipe.dae")
    return tmp_path


def warnings_of(text: str, folder: Path) -> list[str]:
    path = folder / "m.sdf"
    path.write_text(SDF.format(text))
    report = Diagnostics()
    load(str(path), report, packages=Packages({"HOME": "/nobody"}, start=path))
    return [warning.removeprefix(f"{folder}/") for warning in report.warnings]


LONG = "a" * 5000
MESH = "<geometry><mesh><uri>{}</uri></mesh></geometry>"
MAP = "<material><pbr><metal><albedo_map>{}</albedo_map></metal></pbr></material>"
SCRIPT = "<material><script><uri>{}</uri><name>red</name></script></material>"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (LINK.format(MESH), 3),
        (LINK.format(BOX + MAP), 3),
        (LINK.format(BOX + SCRIPT), 3),
        ("<world name='w'><include>\n<uri>{}</uri></include></world>", 2),
    ],
)
def test_impossible_file_names_in_an_sdf_are_reported(folder: Path, text: str, line: int) -> None:
    for uri in ("pipe.dae", "package://arm/pipe.dae"):
        warnings = warnings_of(text.format(uri), folder)
        named = f"{uri}: " * (uri != "pipe.dae")
        pipe = f"{named}{folder}/pipe.dae is a pipe, a device or a socket, not a file"
        assert warnings[0].startswith(f"m.sdf:{line}: warning: {pipe}; ")

    for uri in (
        "a" * 5000,
        f"model://{'a' * 5000}",
        f"package://arm/{'a' * 5000}",
        "file:///a%00b",
        "a%00b",
        "x/" * 3000,
    ):
        warnings = warnings_of(text.format(uri), folder)
        assert warnings[0].startswith(f"m.sdf:{line}: warning: ")
        assert len(warnings[0]) < 1000


def test_impossible_file_names_in_a_urdf_are_reported(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    visual = "\n<visual><geometry><mesh filename='{}'/></geometry></visual>"
    inertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
    link = f"<inertial><mass value='1'/>{inertia}</inertial>{visual}"
    path = folder / "r.urdf"
    for name, warnings in (
        ("pipe.dae", f"{folder}/pipe.dae is a pipe"),
        (LONG, f"no such file {folder}/aaaa"),
        (f"package://{LONG}/a.dae", "package://aaaa"),
        ("a%00b", f"no such file {folder}/a%00b"),
    ):
        path.write_text(f"<robot name='r'><link name='base'>{link.format(name)}</link></robot>")
        assert main(["check", str(path)]) == 0
        assert f"r.urdf:2: warning: {warnings}" in capsys.readouterr().out


def test_an_include_with_a_bracket_in_its_host_name_is_left_out(folder: Path) -> None:
    warnings = warnings_of("<world name='w'><include><uri>https://[fuel/a/b/c</uri></include></world>", folder)

    assert "nothing is fetched from the network" in warnings[0]


def test_a_material_script_that_is_a_pipe_is_left_out(folder: Path) -> None:
    (folder / "scripts").mkdir()
    os.mkfifo(folder / "scripts/red.material")

    warnings = warnings_of(LINK.format(BOX + SCRIPT.format("scripts")), folder)

    why = "cannot be read: it is a pipe, not a regular file"
    assert warnings[0] == f"scripts/red.material: warning: {why}; this material script is left out"


@pytest.mark.parametrize(
    "text",
    ["<xacro:include filename='pipe.dae'/>", "<link name=\"${xacro.load_yaml('pipe.dae')}\"/>"],
)
def test_irregular_files_named_in_a_xacro_are_refused(folder: Path, text: str) -> None:
    path = folder / "r.xacro"
    path.write_text(XACRO.format(text))

    with pytest.raises(
        DescriptionError, match=r"r\.xacro:1: error: \S*/pipe\.dae: it is a pipe, not a regular file \["
    ):
        expand_xacro(path, {}, packages=Packages({}, start=path), report=Diagnostics())


def test_a_model_config_that_is_a_pipe_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "model.config")

    with pytest.raises(DescriptionError, match=r"model\.config: error: cannot be read: it is a pipe"):
        model_file(tmp_path, Diagnostics())


def test_a_model_config_is_read_as_leniently_as_sdf(tmp_path: Path) -> None:
    (tmp_path / "model.config").write_text(
        "<model>\n<author>Ann & Bob</author><sdf version='1.6'>model.sdf</sdf></model>"
    )
    (tmp_path / "model.sdf").write_text(SDF.format("<model name='m'><link name='l'/></model>"))
    report = Diagnostics()

    assert model_file(tmp_path, report) == tmp_path / "model.sdf"
    assert "model.config:2: warning: not well-formed XML: " in report.warnings[0]


class TestPipeOnTheCommandLine:
    """`trundle check <(xacro robot.xacro)` names a pipe."""

    @pytest.fixture
    def pipe(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        """Pipe whose writer has ended, and a box in the working directory for it to include."""
        monkeypatch.chdir(tmp_path)
        (tmp_path / "box.sdf").write_text(SDF.format("<model name='box'><link name='l'/></model>"))
        read_end, write_end = os.pipe()
        with os.fdopen(write_end, "w") as writer:
            writer.write(SDF.format("<world name='w'><include><uri>box.sdf</uri></include><oops/></world>"))
        yield f"/dev/fd/{read_end}"
        os.close(read_end)

    def test_it_is_read_once_and_relative_uris_start_in_the_working_directory(
        self, pipe: str, capsys: pytest.CaptureFixture[str]
    ) -> None:
        assert main(["check", pipe]) == 0
        printed = capsys.readouterr().out
        assert "<pipe>:2: warning: <oops>" in printed
        assert "a world (SDF 1.6): 1 models, 1 links" in printed

    def test_a_pipe_on_standard_input_is_read(
        self, pipe: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        with open(pipe) as stdin:
            monkeypatch.setattr(sys, "stdin", stdin)
            assert main(["check", "-"]) == 0
        assert "<stdin>:2: warning: <oops>" in capsys.readouterr().out

    def test_a_pipe_without_a_writer_ends_with_an_error(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        monkeypatch.setattr("trundle.base.files._TIMEOUT_S", 0.01)
        os.mkfifo(tmp_path / "robot.urdf")

        assert main(["check", str(tmp_path / "robot.urdf")]) == 1
        assert "cannot be read: no end of the stream within 0.01 s" in capsys.readouterr().out

    def test_a_xacro_is_read_from_a_pipe(self, capfd: pytest.CaptureFixture[str]) -> None:
        read_end, write_end = os.pipe()
        with os.fdopen(write_end, "w") as writer:
            writer.write(XACRO.format("<xacro:property name='x' value='7'/><link name='${x}'/>"))

        assert main(["xacro", f"/dev/fd/{read_end}"]) == 0
        assert '<link name="7"/>' in capfd.readouterr().out
        os.close(read_end)

    @pytest.mark.parametrize(
        "robot",
        [
            "<property name='x' value='7'/><link name='l${x}'/>",
            "<macro name='m' params='n'><link name='${n}'/></macro><m n='l7'/>",
        ],
    )
    def test_a_xacro_of_indigo_is_expanded_as_from_a_file(self, robot: str, tmp_path: Path) -> None:
        joint = "<joint name='j' type='fixed'><parent link='base'/><child link='l7'/></joint>"
        text, report = XACRO.format(robot + joint), Diagnostics()
        packages = Packages({}, start=tmp_path)
        (tmp_path / "robot.urdf").write_text(text)

        from_file = load(str(tmp_path / "robot.urdf"), Diagnostics(), packages=packages).robot
        from_pipe = load_text(text, name="<stdin>", folder=tmp_path, packages=packages, report=report).robot

        assert from_file is not None
        assert from_pipe is not None
        assert [link.name for link in from_file.links] == [link.name for link in from_pipe.links] == ["base", "l7"]
        assert "is Indigo's syntax" in report.warnings[0]

"""Reading of regular files, and of pipes from the command line."""

import io
import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from trundle.base import files
from trundle.base.diagnostics import DescriptionError, Diagnostics, TrundleError, UsageError

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no FIFOs, /dev or /proc")


@pytest.fixture
def fifo(tmp_path: Path) -> Path:
    """A named pipe without a writer."""
    os.mkfifo(tmp_path / "fifo")
    return tmp_path / "fifo"


def error_of(read: Callable[[], object]) -> str:
    with pytest.raises(OSError, match=r".") as caught:
        read()
    return str(caught.value.strerror)


def test_only_regular_files_are_read(fifo: Path) -> None:
    assert error_of(lambda: files.read_file(fifo)) == "it is a pipe, not a regular file"
    assert error_of(lambda: files.read_file("/dev/zero")) == "it is a device, not a regular file"
    assert error_of(lambda: files.read_file(fifo.parent)) == "it is a folder, not a file"
    assert error_of(lambda: files.read_file(fifo.with_name("no"))) == "No such file or directory"


@pytest.mark.parametrize("name", ["a\0b", "\ud800"])
def test_invalid_names_are_reported(name: str) -> None:
    assert error_of(lambda: files.read_file(name)) == "no file can have this name"


def test_size_limit_is_checked_while_reading(tmp_path: Path) -> None:
    """Files of /proc have contents but size 0."""
    file = tmp_path / "full"
    file.write_bytes(b"12345")

    assert files.read_file(file, max_bytes=5) == b"12345"
    assert error_of(lambda: files.read_file(file, max_bytes=4)) == "larger than 4 bytes, the largest file read"
    assert files.read_file("/proc/self/status")
    assert "larger than 9 bytes" in error_of(lambda: files.read_file("/proc/self/status", max_bytes=9))


def test_text_has_unix_line_ends_and_replaced_invalid_bytes(tmp_path: Path) -> None:
    (tmp_path / "text").write_bytes(b"a\r\nb\rc\xff")

    assert files.read_text(tmp_path / "text") == "a\nb\nc\ufffd"


def test_a_pipe_is_read_to_its_end() -> None:
    """The writer may have ended by then, as with <(cat robot.urdf)."""
    reader, writer = os.pipe()
    os.write(writer, b"<robot/>")
    os.close(writer)

    assert files.is_stream(f"/dev/fd/{reader}")
    assert files.read_stream(f"/dev/fd/{reader}") == b"<robot/>"

    os.close(reader)


def test_a_pipe_without_a_writer_times_out(fifo: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "_TIMEOUT_S", 0.05)

    assert error_of(lambda: files.read_stream(fifo)) == "no end of the stream within 0.05 s"


def test_an_endless_stream_is_refused_at_the_size_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "MAX_BYTES", 100_000)

    assert error_of(lambda: files.read_stream("/dev/zero")) == "larger than 100000 bytes, the largest file read"


def test_open_descriptors_are_streams_even_of_regular_files(tmp_path: Path) -> None:
    """`trundle check /dev/stdin < robot.urdf`: its files are relative to the working directory, not to /dev."""
    (tmp_path / "robot.urdf").write_text("<robot/>")
    with (tmp_path / "robot.urdf").open() as file:
        name = f"/dev/fd/{file.fileno()}"
        assert (files.is_stream(name), files.read_input(name)) == (True, b"<robot/>")


def test_files_folders_and_missing_paths_are_no_streams(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    assert not any(files.is_stream(path) for path in (tmp_path, tmp_path / "file", tmp_path / "no", "a\0b"))


@pytest.mark.parametrize("text", ["x: 1\n", ""])
def test_standard_input_may_be_a_string_io(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO(text))
    assert files.read_standard_input() == text.encode()


class TestEveryReader:
    """All readers refuse a pipe, instead of waiting for its writer."""

    MESSAGE = "it is a pipe, not a regular file"

    def test_of_meshes(self, fifo: Path) -> None:
        from trundle.robots.meshes import load_mesh, load_motion, load_skin

        fifo = fifo.rename(fifo.with_name("fifo.dae"))
        for reader in (load_mesh, load_skin, load_motion):
            with pytest.raises(TrundleError, match=self.MESSAGE):
                reader(fifo)

    def test_of_images(self, fifo: Path) -> None:
        from trundle.robots.meshes import png_of, read_heights
        from trundle.sim.render.textures import load_texture

        assert png_of(fifo) is None
        assert load_texture(fifo) == self.MESSAGE
        with pytest.raises(TrundleError, match=self.MESSAGE):
            read_heights(fifo)

    def test_of_maps(self, fifo: Path) -> None:
        from trundle.gazebo.nodes.map_server.occupancy_grid import read_map

        keys = "resolution: 1, origin: [0, 0, 0], negate: 0, occupied_thresh: 1, free_thresh: 0"
        map_file = fifo.with_name("map.yaml")
        map_file.write_text(f"{{image: {fifo}, {keys}}}")
        for file in (fifo, map_file):
            with pytest.raises(UsageError, match=self.MESSAGE):
                read_map(file)

    def test_of_rviz_configurations(self, fifo: Path) -> None:
        from trundle.page.graph_page import read_rviz_file

        with pytest.raises(DescriptionError, match=self.MESSAGE):
            read_rviz_file(fifo)

    def test_of_recordings(self, fifo: Path) -> None:
        from trundle.ros import RosError, open_bag
        from trundle.sim.simulation import read_state_log

        with pytest.raises(RosError, match=self.MESSAGE):
            open_bag(fifo)
        assert error_of(lambda: read_state_log(fifo)) == self.MESSAGE

    def test_of_launch_files(self, fifo: Path) -> None:
        from trundle.robots.launch import read_launch_text
        from trundle.robots.packages import Packages

        def read(tag: str) -> None:
            text = f"<launch>\n{tag}</launch>"
            read_launch_text(text, name="a.launch", packages=Packages({}, start=fifo), report=Diagnostics())

        for tag in ("<rosparam file='{}'/>", "<param name='a' textfile='{}'/>"):
            with pytest.raises(DescriptionError, match=rf"a\.launch:2: error: .*{self.MESSAGE}"):
                read(tag.format(fifo))
        with pytest.raises(DescriptionError, match=rf"fifo: error: .*{self.MESSAGE}; included at a\.launch:2"):
            read(f"<include file='{fifo}'/>")
        with pytest.raises(DescriptionError, match=r"a\.launch:2: error: no launch file 'aaa"):
            read(f"<include file='{'a' * 5000}'/>")

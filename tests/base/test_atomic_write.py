"""Output files are written completely or not at all, and never replace a device."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.base.atomic_write import replaced_atomically, write_atomically
from trundle.base.diagnostics import UsageError

MODEL = '<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>'
DEV_FULL = Path("/dev/full")


@pytest.fixture
def model(tmp_path: Path) -> str:
    (tmp_path / "m.sdf").write_text(MODEL)
    return str(tmp_path / "m.sdf")


def test_writing_through_a_link_keeps_the_link_and_the_permissions(tmp_path: Path) -> None:
    file, link = tmp_path / "a.txt", tmp_path / "link"
    link.symlink_to(file)

    write_atomically(link, "α")
    file.chmod(0o600)
    write_atomically(link, "β")

    assert file.read_bytes() == "β".encode()
    assert file.stat().st_mode & 0o777 == 0o600
    assert link.is_symlink()
    assert {path.name for path in tmp_path.iterdir()} == {"a.txt", "link"}


def test_a_pipe_is_written_into(tmp_path: Path, model: str) -> None:
    """As with `trundle convert … -o /dev/stdout`, which must not replace the device by a file."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["cat", str(pipe)], stdout=subprocess.PIPE, text=True) as reader:
        assert main(["convert", model, "--to", "sdf", "-o", str(pipe)]) == 0
        assert reader.communicate()[0].startswith("<?xml")
    assert pipe.is_fifo()


def test_a_failed_write_leaves_no_files(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(UsageError, match=r"cannot write .*folder: Is a directory"):
        write_atomically(tmp_path / "folder", "a")
    with pytest.raises(UsageError, match=r"cannot write .*none/a: No such file"):
        write_atomically(tmp_path / "none/a", "a")
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


@pytest.mark.parametrize("has_links", [True, False])
def test_an_existing_file_is_not_replaced_unless_requested(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, has_links: bool
) -> None:
    """On a disk with hard links and on one without."""

    def refuse(*_: object) -> None:
        raise OSError

    if not has_links:
        monkeypatch.setattr(os, "link", refuse)
    write_atomically(tmp_path / "a", "mine", replace=False)
    with pytest.raises(FileExistsError):
        write_atomically(tmp_path / "a", "yours", replace=False)
    assert (tmp_path / "a").read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


@pytest.mark.skipif(not DEV_FULL.is_char_device(), reason="this system has no /dev/full")
def test_a_full_disk_is_reported_in_one_line(model: str) -> None:
    words = [sys.executable, "-m", "trundle", "check", model]
    with DEV_FULL.open("w") as full:
        process = subprocess.run(words, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    graph_process = subprocess.run([*words, "--graph", str(DEV_FULL)], capture_output=True, text=True, check=False)

    assert (process.returncode, graph_process.returncode) == (1, 1)
    assert (
        process.stderr.splitlines()[-1] == "trundle check: error: the output cannot be written: No space left on device"
    )
    assert (
        graph_process.stderr.splitlines()[-1] == "trundle check: error: cannot write /dev/full: No space left on device"
    )
    assert "Traceback" not in process.stderr + graph_process.stderr


def _fail(partial: Path) -> None:
    partial.write_text("bad")
    assert partial.suffix == ".png"
    raise OSError("full")


def test_replaced_atomically_keeps_the_old_file_after_an_error(tmp_path: Path) -> None:
    file, link = tmp_path / "a.png", tmp_path / "link.png"
    link.symlink_to(file)
    file.write_text("good")
    file.chmod(0o600)
    with pytest.raises(OSError, match="full"), replaced_atomically(link) as partial:
        _fail(partial)
    assert file.read_text() == "good"
    with replaced_atomically(link) as partial:
        partial.write_text("better")
    assert (file.read_text(), file.stat().st_mode & 0o777, link.is_symlink()) == ("better", 0o600, True)
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "link.png"}


@pytest.mark.skipif(os.name != "posix", reason="this system has no limit of file sizes")
@pytest.mark.parametrize("name", ["a.png", "a.gif"])
def test_an_image_that_does_not_fit_keeps_the_old_file(tmp_path: Path, name: str) -> None:
    shape = "<visual name='v'><geometry><box><size>1 1 1</size></box></geometry></visual>"
    (tmp_path / "m.sdf").write_text(MODEL.replace('<link name="l"/>', f'<link name="l">{shape}</link>'))
    (tmp_path / name).write_text("good")
    words = [sys.executable, "-m", "trundle", "render", "m.sdf", "-o", name]
    words += ["--duration", "0.08", "--size", "320x240"] if name.endswith(".gif") else ["--size", "320x240"]
    limited = ["sh", "-c", 'ulimit -f 1; exec "$@"', "sh", *words]  # blocks of 512 bytes, or of 1024
    process = subprocess.run(limited, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (process.returncode, process.stderr.splitlines()[-1]) == (
        1,
        f"trundle render: error: cannot write {name}: File too large",
    )
    assert (tmp_path / name).read_text() == "good"
    assert {path.name for path in tmp_path.iterdir()} == {"m.sdf", name}


@pytest.mark.skipif(os.name != "posix", reason="this system has no limit of file sizes")
@pytest.mark.parametrize(("words", "code"), [("new robot cart", 1), ("--as catkin_create_pkg cart", 2)])
def test_new_files_that_do_not_fit_are_reported_in_one_line(tmp_path: Path, words: str, code: int) -> None:
    limited = ["sh", "-c", 'ulimit -f 0; exec "$@"', "sh", sys.executable, "-m", "trundle", *words.split()]
    process = subprocess.run(limited, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert process.returncode == code
    assert re.search(r"error: cannot write \S*cart[/.]\S+: File too large$", process.stderr), process.stderr
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []

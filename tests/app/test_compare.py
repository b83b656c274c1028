"""`trundle compare`: a table of two logs' differences, and its exit code."""

import csv
import io
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from trundle.app.cli import main

TIMES = np.arange(101) * 0.02


def write_log(file: Path, *, x: float = 0.0, model: str = "box", times: np.ndarray = TIMES, extra: str = "") -> Path:
    """Write a box that drives along x at 1 m/s from x, beside a floor, with a hinge."""
    links = ["floor::link", f"{model}::base", *([f"{extra}::base"] if extra else [])]
    header = {"format": "trundle state log 1", "links": links, "joints": [f"{model}::hinge"], "sdf": "<sdf/>"}
    poses = np.zeros((len(times), len(links), 7))
    poses[..., 3] = 1.0
    poses[:, 1, 0] = x + times
    rows = np.concatenate([times[:, None], poses.reshape(len(times), -1), (2 * times)[:, None]], axis=1)
    file.write_bytes(json.dumps(header).encode() + b"\n" + rows.astype("<f8").tobytes())
    return file


def test_the_table_has_what_moves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, other = write_log(tmp_path / "a.log", x=0.25), write_log(tmp_path / "b.log")

    assert main(("compare", str(one), str(other), "--csv")) == 0

    rows = list(csv.reader(io.StringIO(capsys.readouterr().out)))[1:]
    assert [row[:2] for row in rows] == [["box", "distance"], ["box", "angle"], ["box::hinge", "position"]]
    assert [float(cell) for cell in rows[0][2:]] == pytest.approx([0.25, float(rows[0][3]), 0.25, 0.25])
    assert [float(cell) for row in rows[1:] for cell in row[2:]] == [0.0] * 8


def test_the_exit_code_tells_if_the_tolerance_is_exceeded(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, other = write_log(tmp_path / "a.log", x=0.25), write_log(tmp_path / "b.log")

    assert main(("compare", str(one), str(other), "--tolerance", "0.26")) == 0
    assert main(("compare", str(one), str(other), "--tolerance", "0.24")) == 1

    printed = capsys.readouterr()
    assert printed.err == "1 of 3 differences exceed 0.24\n"
    assert "box         distance          0.250000" in printed.out
    assert "2.00 s, which both have, are compared" in printed.out


def test_a_model_of_one_log_alone_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, other = write_log(tmp_path / "a.log", extra="crate"), write_log(tmp_path / "b.log", times=TIMES[:51])

    assert main(("compare", str(one), str(other), "--tolerance", "1")) == 1

    printed = capsys.readouterr()
    assert printed.err == "only in a.log: crate\n"
    assert "1.00 s, which both have, are compared" in printed.out


def test_logs_of_other_worlds_and_damaged_ones_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = write_log(tmp_path / "a.log")
    data = log.read_bytes()
    head = data.index(b"\n") + 1
    row = len(data[head:]) // len(TIMES)
    files = {
        "text.log": (b"hello\n", "text.log:1: error: not a state log"),
        "list.log": (b"[]\n" + data[head:], "list.log:1: error: not a state log"),
        "empty.log": (data[:head], "empty.log: error: nothing was recorded"),
        "cut.log": (data[: head + row - 1], "cut.log: error: nothing was recorded"),
        "nan.log": (
            data[: head + row] + np.full(row // 8, np.nan).tobytes() + data[head + 2 * row :],
            "nan.log: error: row 2 of 101 is damaged",
        ),
        "other.log": (
            data[:head].replace(b"floor", b"grass").replace(b"box", b"car") + data[head:],
            "have no model in common: floor, box and grass, car",
        ),
    }
    for name, (content, _) in files.items():
        (tmp_path / name).write_bytes(content)

    for name, (_, sentence) in files.items():
        for words in ((str(log), str(tmp_path / name)), (str(tmp_path / name), str(log))):
            assert main(("compare", *words)) == 1
        assert sentence in capsys.readouterr().err


def test_names_with_control_characters_stay_on_their_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    name = "box\x1b[2J\nrm"
    one, other = (
        write_log(tmp_path / f"{end}.log", model=name, extra=extra) for end, extra in (("a", "\x1b"), ("b", ""))
    )

    main(("compare", str(one), str(other)))

    printed = capsys.readouterr()
    assert "\x1b" not in printed.out + printed.err
    assert len(printed.out.splitlines()) == 5


def test_comparing_loads_no_physics(tmp_path: Path) -> None:
    """A log is read with NumPy alone."""
    words = [str(write_log(tmp_path / name)) for name in ("a.log", "b.log")]
    code = "import sys; from trundle.app.cli import main; main(); "
    code += "print(*sorted({'mujoco', 'lxml', 'aiohttp'} & set(sys.modules)), file=sys.stderr)"

    done = subprocess.run([sys.executable, "-c", code, "compare", *words], capture_output=True, text=True, check=True)

    assert "box" in done.stdout
    assert done.stderr.strip() == ""

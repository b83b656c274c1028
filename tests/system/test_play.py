"""`trundle play` of recorded runs."""

import re
import shutil
import subprocess
import sys
import urllib.request

import numpy as np
import pytest

from trundle.sim.simulation import read_state_log


def test_a_recorded_run_is_played_on_a_page(start, trundle, until, tmp_path) -> None:
    file = tmp_path / "m.sdf"
    file.write_text('<sdf version="1.6"><model name="m"><pose>0 0 2 0 0 0</pose><link name="a"/></model></sdf>')
    log = tmp_path / "run.log"
    done = trundle(
        "run", str(file), "--headless", "--no-ros", "--speed", "max", "--duration", "1", "--record", str(log)
    )
    assert done.returncode == 0, done.stderr

    playing = start("play", str(log), "--pause")
    until("the page", lambda: "see it at" in playing.output())
    match = re.search(r"see it at (http://127\.0\.0\.1:\d+/\?token=[\w-]+)", playing.output())
    assert match is not None
    with urllib.request.urlopen(match[1], timeout=10) as page:
        assert page.status == 200
    assert playing.interrupt() == 130
    assert "Traceback" not in playing.output()


def test_a_run_whose_recording_cannot_be_written_fails(env, tmp_path) -> None:
    """A full disk, simulated by a file size limit of 20 blocks of 512 or 1024 bytes."""
    file, log = tmp_path / "m.sdf", tmp_path / "run.log"
    file.write_text('<sdf version="1.6"><model name="m"><pose>0 0 2 0 0 0</pose><link name="a"/></model></sdf>')
    words = ["run", file, "--headless", "--no-ros", "--speed", "max", "--duration", "9", "--record", log]
    limited = ["sh", "-c", 'ulimit -f 20 && exec "$@"', "sh", sys.executable, "-m", "trundle", *words]
    done = subprocess.run(limited, env=env, capture_output=True, text=True, check=False)

    assert done.returncode == 1, done.stderr
    assert f"recording failed: {log}: File too large; trundle play shows what was recorded" in done.stderr
    assert "s simulated in" in done.stdout
    times = read_state_log(log).times_s
    assert 10 < len(times) < 9 * 50
    assert times == pytest.approx(np.arange(len(times)) * 0.02)


def test_a_file_that_is_not_a_recording_is_an_error(trundle, tmp_path) -> None:
    file = tmp_path / "x.log"
    file.write_text("hello\n")

    done = trundle("play", str(file))

    assert done.returncode == 1
    assert done.stderr.strip().endswith("error: not a state log: the file does not begin with 'trundle state log 1'")


def test_a_run_whose_recording_is_removed_fails(start, until, tmp_path) -> None:
    file, folder = tmp_path / "m.sdf", tmp_path / "logs"
    folder.mkdir()
    file.write_text('<sdf version="1.6"><model name="m"><pose>0 0 2 0 0 0</pose><link name="a"/></model></sdf>')
    running = start("run", str(file), "--headless", "--no-ros", "--record", str(folder / "run.log"))
    log = folder / "run.log"
    until(
        "two states to be recorded",
        lambda: log.exists() and log.stat().st_size and len(read_state_log(log).times_s) > 1,
    )
    shutil.rmtree(folder)

    assert running.process.wait(60) == 1
    assert f"recording failed: {log}: No such file or directory" in running.output()

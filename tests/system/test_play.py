"""Recorded and shown again."""

import re
import urllib.request


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
    found = re.search(r"see it at (http://127\.0\.0\.1:\d+)", playing.output())
    assert found is not None
    with urllib.request.urlopen(found[1], timeout=10) as page:
        assert page.status == 200
    assert playing.interrupt() == 130
    assert "Traceback" not in playing.output()


def test_what_is_no_recording_is_refused_in_a_sentence(trundle, tmp_path) -> None:
    file = tmp_path / "x.log"
    file.write_text("hello\n")

    done = trundle("play", str(file))

    assert done.returncode == 1
    assert done.stderr.strip().endswith("error: no state log: it does not begin with 'trundle state log 1'")

"""Sensors publish what docs/physics.md states."""

import re

import pytest
from tests.physics_page import PAGE

_ROW = re.compile(r"\| [^|]+ \| `(?P<topic>/[^`]+)` \| .* \| (?P<figure>-?[\d.]+) ± (?P<tolerance>[\d.]+) \|")


@pytest.mark.slow
def test_a_topic_has_what_its_row_says(trundle, start, master, until) -> None:
    rows = [found for line in PAGE.read_text().splitlines() if (found := _ROW.fullmatch(line))]
    start("run", "physics/sensors.world", "--headless")
    until("its sensors", lambda: "/robot/wrist/force/wrench" in dict(master.call("getTopicTypes")))

    assert len(rows) == 4
    for row in rows:
        done = trundle("topic", "echo", "-n", "1", row["topic"])
        assert done.returncode == 0, done.stderr
        assert float(done.stdout.split()[0]) == pytest.approx(float(row["figure"]), abs=float(row["tolerance"]))

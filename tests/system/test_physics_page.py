"""Sensors publish the values in docs/physics.md."""

import re

import pytest
from tests.physics_page import PAGE

_ROW = re.compile(r"\| [^|]+ \| `(?P<topic>/[^`]+)` \| .* \| (?P<figure>-?[\d.]+) ± (?P<tolerance>[\d.]+) \|")


@pytest.mark.slow
def test_topics_have_the_documented_values(trundle, start, master, until) -> None:
    rows = [match for line in PAGE.read_text().splitlines() if (match := _ROW.fullmatch(line))]
    start("run", "physics/sensors.world", "--headless")
    until("its sensors", lambda: "/robot/wrist/force/wrench" in dict(master.call("getTopicTypes")))

    assert len(rows) == 4
    for row in rows:
        done = trundle("topic", "echo", "-n", "1", row["topic"])
        assert done.returncode == 0, done.stderr
        assert float(done.stdout.split()[0]) == pytest.approx(float(row["figure"]), abs=float(row["tolerance"]))

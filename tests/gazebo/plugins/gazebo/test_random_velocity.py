"""A link that draws velocities."""

import math
from pathlib import Path

import pytest
from tests.gazebo.plugins.plugin_world import BODY, load

PLUGIN = '<link name="l">{}</link><plugin name="p" filename="libRandomVelocityPlugin.so"><link>l</link>{}</plugin>'


def test_a_velocity_holds_for_its_period_and_repeats_after_a_reset(tmp_path: Path) -> None:
    parameters = "<initial_velocity>0.5 0 0</initial_velocity><velocity_factor>2</velocity_factor>"
    parameters += "<update_period>0.5</update_period><min_z>0</min_z><max_z>0.1</max_z>"
    sim = load(tmp_path, PLUGIN.format(BODY.format(1), parameters))
    link = sim["m"].link("l")
    runs: list[list[tuple[float, float, float]]] = []
    for _ in range(2):
        sim.reset()
        sim.run(0.4)
        assert link.pose.position == pytest.approx((0.2, 0, 0))
        runs.append([])
        for _ in range(3):
            sim.run(0.5)
            runs[-1].append(link.twist.linear)

    assert runs[0] == runs[1]
    assert len(set(runs[0])) == 3
    for x, y, z in runs[0]:
        assert 0 <= z <= 0.1
        assert math.hypot(x, y, z) <= 2.0 + 1e-9
    assert any(math.hypot(x, y) > 0.5 for x, y, _ in runs[0])


def test_a_link_with_a_parent_joint_is_not_moved_but_reported(tmp_path: Path) -> None:
    fixed = '<joint name="j" type="fixed"><parent>world</parent><child>l</child></joint>'
    sim = load(tmp_path, PLUGIN.format(BODY.format(1), "") + fixed)
    sim.run(0.1)

    assert sim["m"].link("l").pose.position == (0, 0, 0)
    assert "has a joint to its parent" in sim.report.warnings[0]

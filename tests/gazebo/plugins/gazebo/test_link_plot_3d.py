"""The path of a link as a line."""

import math
from pathlib import Path

import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.page.simulated_world.lines import plugin_lines
from trundle.spatial import Twist

PLOT = """<link name="l">{body}</link><plugin name="p" filename="libLinkPlot3DPlugin.so"><frequency>100</frequency>
<plot><link>l</link><pose>0.5 0 0 0 0 0</pose><material>Gazebo/Red</material></plot>
<plot><link>l</link></plot><plot><link>elsewhere</link></plot></plugin>"""


def test_a_point_of_a_rotating_link_draws_a_circle(tmp_path: Path) -> None:
    node = FakeNode()
    sim = load(tmp_path, PLOT.format(body=BODY.format(1)), node=node)
    sim["m"].set_twist(Twist(angular=(0.0, 0.0, 1.0)))
    sim.run(3.0)

    pen, middle = sim.lines.values()
    assert pen.rgb == (1.0, 0.0, 0.0)
    assert len(middle.points) == 1
    assert [math.hypot(*point) for point in pen.points] == pytest.approx([0.5] * len(pen.points))
    gaps = [math.dist(a, b) for a, b in zip(pen.points, pen.points[1:], strict=False)]
    assert all(0.05 < gap < 0.06 for gap in gaps)
    assert len(pen.points) == pytest.approx(3.0 * 0.5 / 0.055, rel=0.1)
    marker = node.published["/marker"][-1]
    assert (marker.ns, marker.type, len(marker.points)) == ("plot_l", 4, len(pen.points))
    assert [warning.split(": ", 2)[2] for warning in sim.report.warnings] == [
        "<plot>: model 'm' has no link 'elsewhere'; there are: 'l'; it is left out"
    ]

    (first, *_) = plugin_lines(sim)
    assert first.points.shape == (len(pen.points), 3)
    assert first.rgba == (255, 0, 0, 255)
    sim.reset()
    assert pen.points == []
    sim.delete("m")
    assert sim.lines == {}


def test_a_line_keeps_its_newest_thousand_points(tmp_path: Path) -> None:
    sim = load(tmp_path, PLOT.format(body=BODY.format(1)))
    sim["m"].set_twist(Twist((10.0, 0.0, 0.0)))
    sim.run(11.0)

    _, middle = sim.lines.values()
    assert 995 <= len(middle.points) <= 1000
    assert middle.points[-1][0] == pytest.approx(110.0, abs=0.11)

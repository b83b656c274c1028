"""A weight on a winch."""

from pathlib import Path

import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

PLUGIN = """<link name="l"><pose>0 0 2 0 0 0</pose>{body}</link><plugin name="p" filename="libHarnessPlugin.so">
<joint name="rope" type="prismatic"><parent>world</parent><child>l</child><axis><xyz>0 0 1</xyz><limit><lower>-5</lower>
<upper>5</upper></limit></axis></joint><winch><joint>rope</joint><pos_pid><p>1000</p><d>150</d><cmd_max>1000</cmd_max>
<cmd_min>-1000</cmd_min></pos_pid><vel_pid><p>1000</p><cmd_max>1000</cmd_max></vel_pid></winch>{detach}</plugin>"""


def test_a_harness_holds_lifts_and_releases_a_weight(tmp_path: Path) -> None:
    """4 kg on 1000 N/m sag by m·g/p, lag by m·g/p of the speed loop when lifted, and fall freely when released."""
    node = FakeNode()
    plugin = PLUGIN.format(body=BODY.format(4), detach="<detach>rope</detach>")
    sim = load(tmp_path, plugin, gravity="0 0 -10", node=node)
    link = sim["m"].link("l")
    assert sim.report.warnings == []

    sim.run(8.0)
    assert link.pose.position[2] == pytest.approx(2.0 - 40 / 1000, abs=1e-3)
    node.receive("/m/harness/velocity", data=0.5)
    sim.run(1.0)
    assert link.twist.linear[2] == pytest.approx(0.5 - 40 / 1000, abs=2e-3)
    node.receive("/m/harness/velocity", data=0.0)
    height = link.pose.position[2]
    sim.run(8.0)
    assert link.pose.position[2] == pytest.approx(height - 40 / 1000, abs=2e-3)

    height = link.pose.position[2]
    node.receive("/m/harness/detach", data=True)
    node.receive("/m/harness/detach", data=True)
    sim.run(0.5)
    assert link.pose.position[2] == pytest.approx(height - 0.5 * 10 * 0.5**2, abs=3e-3)


def test_a_harness_without_a_valid_joint_is_reported(tmp_path: Path) -> None:
    sim = load(tmp_path, PLUGIN.format(body=BODY.format(4), detach="<detach>string</detach>"))
    (warning,) = sim.report.warnings
    assert warning.endswith("harness: no joint 'string' for <detach>; the first one is used")

    sim = load(tmp_path, f'<link name="l">{BODY.format(1)}</link><plugin name="p" filename="libHarnessPlugin.so"/>')
    assert "a harness needs a <joint>" in sim.report.warnings[0]

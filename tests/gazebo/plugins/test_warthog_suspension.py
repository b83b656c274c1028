"""The Warthog's suspension against a damped harmonic oscillator."""

import math
from pathlib import Path

import pytest
from tests.gazebo.plugins.plugin_world import BODY, load

UNIT = (
    f'<link name="{{0}}">{BODY.format(1)}</link><joint name="{{0}}_diff_unit_joint" type="revolute">'
    "<parent>base</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"
)
BASE = (
    f'<link name="base">{BODY.format(1)}</link><joint name="weld" type="fixed"><parent>world</parent>'
    "<child>base</child></joint>"
)
PLUGIN = '<plugin name="p" filename="libwarthog_suspension_plugin.so">{}</plugin>'
STIFFNESS, DAMPING, INERTIA = 10.0, 0.4, 0.1


def test_units_swing_as_damped_oscillators(tmp_path: Path) -> None:
    """q(t) = e^(−γt) (cos ωt + γ/ω sin ωt) q(0) with γ = b/2I and ω² = k/I − γ²."""
    gains = f"<suspension_k>{STIFFNESS}</suspension_k><suspension_b>{DAMPING}</suspension_b>"
    sim = load(tmp_path, BASE + UNIT.format("left") + UNIT.format("right") + PLUGIN.format(gains))
    left, right = (sim["m"].joint(f"{side}_diff_unit_joint") for side in ("left", "right"))
    left.set_position(0.2)
    sim.run(0.7)

    decay = DAMPING / (2 * INERTIA)
    omega = math.sqrt(STIFFNESS / INERTIA - decay**2)
    swing = math.cos(omega * 0.7) + decay / omega * math.sin(omega * 0.7)
    assert left.position == pytest.approx(0.2 * math.exp(-decay * 0.7) * swing, abs=2e-3)
    assert right.position == pytest.approx(0.0, abs=1e-9)
    assert sim.report.warnings == []


def test_a_missing_suspension_joint_is_reported(tmp_path: Path) -> None:
    sim = load(tmp_path, BASE + UNIT.format("left") + PLUGIN.format(""))

    assert "no joint 'right_diff_unit_joint'" in " ".join(sim.report.warnings)

"""Actor of libActorPlugin.so."""

import math
from pathlib import Path

import pytest

import trundle
from trundle.gazebo.model_plugins import load_plugins
from trundle.sim.simulation import Simulation

ACTOR = """<sdf version="1.6"><world name="w"><actor name="walker"><pose>0 0 1.2138 1.5707 0 0</pose><skin>
<filename>none.dae</filename></skin><script><trajectory id="0" type="walking"><waypoint><time>5</time>
<pose>9 9 0 0 0 0</pose></waypoint></trajectory></script><plugin name="p" filename="libActorPlugin.so">
<target>0 -2 1.2138</target><target_weight>1</target_weight>{more}</plugin></actor>{models}</world></sdf>"""


def load(folder: Path, more: str = "", models: str = "") -> Simulation:
    file = folder / "w.sdf"
    file.write_text(ACTOR.format(more=more, models=models))
    sim = trundle.load(str(file))
    load_plugins(sim, None, {}, say=lambda _: None)
    return sim


def test_it_walks_to_its_target_at_its_pace_and_on_to_others(tmp_path: Path) -> None:
    sim = load(tmp_path)
    walker = sim["walker"]
    sim.run(1.0)
    assert walker.pose.position == pytest.approx((0, -0.8, 1.2138), abs=2e-3)

    targets = 0
    for _ in range(30):
        before = walker.pose.position
        sim.run(0.5)
        x, y, z = walker.pose.position
        assert -3 <= x <= 3.5
        assert -10 <= y <= 2
        assert z == pytest.approx(1.2138)
        assert math.dist(before, (x, y, z)) <= 0.8 * 0.5 + 1e-6
        targets += math.dist((x, y), (0, -2)) > 1.0
    assert targets > 0


def test_it_keeps_away_from_models_but_those_it_ignores(tmp_path: Path) -> None:
    post = '<model name="post"><static>1</static><pose>0.5 -1 1.2138 0 0 0</pose><link name="l"/></model>'
    ends = [
        load(tmp_path, more, models=post) for more in ("", "<ignore_obstacles><model>post</model></ignore_obstacles>")
    ]
    nearest = [9.0, 9.0]
    for _ in range(20):
        for i, sim in enumerate(ends):
            sim.run(0.1)
            nearest[i] = min(nearest[i], math.dist(sim["walker"].pose.position, (0.5, -1, 1.2138)))

    shy, bold = nearest
    assert bold == pytest.approx(0.5, abs=5e-3), "it passes beside it"
    assert shy > 0.9, "which is where it turns away from it"


def test_its_bones_keep_step_with_what_it_covers(tmp_path: Path) -> None:
    """2 s of the animation per metre; a reset restarts it."""
    sim = load(tmp_path, more="<animation_factor>2</animation_factor>")
    start = sim["walker"].pose.position

    sim.run(1.0)
    moment = sim.animation_state("walker")

    assert moment.animation == "walking"
    assert not moment.placed
    assert moment.time_s == pytest.approx(2.0 * math.dist(start, sim["walker"].pose.position), rel=1e-3)
    sim.reset()
    assert sim.animation_state("walker").time_s == 0.0

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
    load_plugins(sim, None, {}, log=lambda _: None)
    return sim


def test_an_actor_walks_to_its_target_at_its_speed_and_then_to_others(tmp_path: Path) -> None:
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


def test_an_actor_avoids_models_except_ignored_ones(tmp_path: Path) -> None:
    post = '<model name="post"><static>1</static><pose>0.5 -1 1.2138 0 0 0</pose><link name="l"/></model>'
    sims = [
        load(tmp_path, more, models=post) for more in ("", "<ignore_obstacles><model>post</model></ignore_obstacles>")
    ]
    nearest = [9.0, 9.0]
    for _ in range(20):
        for i, sim in enumerate(sims):
            sim.run(0.1)
            nearest[i] = min(nearest[i], math.dist(sim["walker"].pose.position, (0.5, -1, 1.2138)))

    avoiding, ignoring = nearest
    assert ignoring == pytest.approx(0.5, abs=5e-3), "an ignored model is passed closely"
    assert avoiding > 0.9, "the actor turns away from the model"


def test_the_animation_advances_with_the_walked_distance(tmp_path: Path) -> None:
    """2 s of the animation per metre; a reset restarts it."""
    sim = load(tmp_path, more="<animation_factor>2</animation_factor>")
    start = sim["walker"].pose.position

    sim.run(1.0)
    state = sim.animation_state("walker")

    assert state.animation == "walking"
    assert not state.placed
    assert state.time_s == pytest.approx(2.0 * math.dist(start, sim["walker"].pose.position), rel=1e-3)
    sim.reset()
    assert sim.animation_state("walker").time_s == 0.0

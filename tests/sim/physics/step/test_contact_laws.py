"""Contact laws: they act between collision detection and solver, in every step, in C."""

import threading
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path

import mujoco
import pytest
from mujoco.batch import Batch

import trundle
from trundle.base.diagnostics import TrundleError
from trundle.sim.physics import _contact_laws
from trundle.sim.physics.step import contact_laws
from trundle.sim.simulation import Simulation
from trundle.spatial import Twist

BALL = """<model name="ball"><pose>{} 0 0.6 0 0 0</pose><link name="l"><inertial><mass>2</mass><inertia><ixx>0.01</ixx>
<iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name="c"><geometry><sphere><radius>0.1</radius></sphere>
</geometry>{}</collision></link></model>"""
FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry>{}</collision></link></model>"""
BOUNCY = """<surface><bounce><restitution_coefficient>0.8</restitution_coefficient><threshold>0.01</threshold></bounce>
</surface>"""
BRICK = "<box><size>0.4 0.3 0.2</size></box>"
DAMPED = """<joint name="j" type="revolute"><parent>world</parent><child>l</child><axis><xyz>1 0 0</xyz><dynamics>
<damping>0.1</damping></dynamics></axis></joint></model>"""
APEX_STEP = 570


@pytest.fixture
def ball(tmp_path: Path) -> Simulation:
    """A ball of e 0.8, half a metre up."""
    return _load(tmp_path, BALL.format(0, BOUNCY) + FLOOR.format(BOUNCY))


@pytest.fixture
def foreign() -> Iterator[list[float]]:
    """Times of calls of another callback, set after Trundle's."""
    calls: list[float] = []

    def note(_: mujoco.MjModel, data: mujoco.MjData) -> None:
        calls.append(data.time)

    mujoco.set_mjcb_control(note)
    yield calls
    mujoco.set_mjcb_control(None)


def _load(folder: Path, models: str) -> Simulation:
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity>{models}</world></sdf>')
    return trundle.load(str(file))


def test_contact_laws_act_in_mujocos_rollout(ball: Simulation) -> None:
    """To the same bits, on two threads, of a copy of the model."""
    simulations = Batch(ball.engine.compiled.model, nsim=4, nthread=2)
    heights = simulations.bind("qpos")

    simulations.step(nstep=APEX_STEP)
    ball.step(APEX_STEP)

    assert ball["ball"].pose.position[2] == pytest.approx(0.1 + 0.64 * 0.5, rel=0.01), "at its apex"
    assert set(heights[:, 2].tolist()) == {ball["ball"].pose.position[2]}


def test_worlds_in_two_threads_do_not_disturb_each_other(tmp_path: Path) -> None:
    sims = [_load(tmp_path, BALL.format(x, BOUNCY) + FLOOR.format(BOUNCY)) for x in (0, 0, 3)]
    sims[0].step(900)
    threads = [threading.Thread(target=sim.step, args=(900,)) for sim in sims[1:]]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert len({sim["ball"].pose.position[2] for sim in sims}) == 1


def test_a_control_callback_of_another_caller_is_called_as_well(ball: Simulation, foreign: list[float]) -> None:
    ball.step(APEX_STEP)

    assert len(foreign) == APEX_STEP
    assert ball["ball"].pose.position[2] > 0.4, "it bounced"


def test_another_release_of_mujoco_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mujoco, "mj_version", lambda: 4_001_000)
    built = ".".join(str(_contact_laws.VERSION // n % 1000) for n in (1_000_000, 1000, 1))

    with pytest.raises(TrundleError, match=f"built for MuJoCo {built}, and mujoco-core 4.1.0 .*mujoco-core=={built}"):
        contact_laws.bind()


def test_a_bouncing_ball_falls_asleep_in_the_end(ball: Simulation) -> None:
    ball.step(8192)

    assert ball.engine.asleep == 1


PLATE = """<model name="plate"><static>1</static><link name="l"><collision name="c"><geometry><box>
<size>2 2 0.002</size></box></geometry></collision></link></model>"""
SMALL_BALL = BALL.format(0, "").replace("<radius>0.1<", "<radius>0.005<")


@contextmanager
def _noted_steps() -> Generator[list[tuple[float, bool]]]:
    """The time of each step, and whether it looks ahead."""
    steps: list[tuple[float, bool]] = []

    def note(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        steps.append((data.time, _looks_ahead(model)))

    mujoco.set_mjcb_control(note)
    try:
        yield steps
    finally:
        mujoco.set_mjcb_control(None)


def _looks_ahead(model: mujoco.MjModel) -> bool:
    return bool(model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SPECULATIVE)


def test_a_world_with_a_thin_shape_uses_speculative_contacts_only_at_high_speed(tmp_path: Path) -> None:
    """Half thicknesses of 5 mm and 1 mm are gone through from 3.3 m/s on; half of that is reached after 0.167 s."""
    sim = _load(tmp_path, SMALL_BALL + PLATE)
    model = sim.engine.compiled.model
    with _noted_steps() as steps:
        sim.step(1000)

    slow = {looks for at, looks in steps if 0.001 < at < 0.16}
    fast = {looks for at, looks in steps if 0.17 < at < 0.34}
    assert (slow, fast) == ({False}, {True})
    assert sim["ball"].pose.position[2] == pytest.approx(0.006, abs=1e-4)
    assert not steps[-1][1], "it lies there"
    assert _looks_ahead(model), "for others that step this model"


CASED = """<model name="robot"><pose>0 0 1 0 0 0</pose><link name="l"><inertial><mass>2</mass><inertia><ixx>0.01</ixx>
<iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name="casing"><geometry><box><size>0.2 0.2 0.1</size>
</box></geometry></collision><collision name="sheet"><pose>{} 0 -0.04 0 0 0</pose><geometry><box>
<size>0.1 0.1 0.0002</size></box></geometry></collision></link></model>"""


@pytest.mark.parametrize(("at_x", "looks"), [(0.05, False), (0.5, True)], ids=["in its casing", "on an arm"])
def test_a_thin_shape_within_a_thick_one_needs_no_speculative_contacts(
    tmp_path: Path, at_x: float, looks: bool
) -> None:
    """Worlds of thousands of thin shapes, as a building's walls, step many times faster without."""
    sim = _load(tmp_path, CASED.format(at_x) + PLATE)
    assert _looks_ahead(sim.engine.compiled.model) == looks

    sim["robot"].set_twist(Twist(linear=(0.0, 0.0, -10.0)))
    sim.step(1000)

    assert sim["robot"].pose.position[2] > 0.0, "nothing went through the plate"


def test_a_world_with_a_thin_shape_uses_speculative_contacts_after_a_write(tmp_path: Path) -> None:
    sim = _load(tmp_path, SMALL_BALL + PLATE)
    with _noted_steps() as steps:
        for _ in range(20):
            sim.step(1)
        sim["ball"].set_twist(Twist(linear=(0.0, 0.0, -3.0)))
        sim.step(2)
        state = sim.save()
        sim.step(1)
        sim.restore(state)
        sim.step(1)
    assert [looks for _, looks in steps] == [True] + 19 * [False] + 4 * [True]
    sim.run(0.5)
    assert sim["ball"].pose.position[2] == pytest.approx(0.006, abs=1e-4)


@pytest.mark.parametrize(
    ("what", "is_plain"),
    [
        ("ball in the air", True),
        ("brick in the air", False),
        ("brick that lies", True),
        ("brick that damps", False),
        ("brick that turns", True),
    ],
)
def test_a_step_is_solved_in_the_metric_that_it_needs(tmp_path: Path, what: str, is_plain: bool) -> None:
    """Without dampers and springs they add nothing to it; a brick's spin has to be integrated implicitly."""
    shape = BALL.format(0, "")
    if "brick" in what:
        shape = shape.replace("<ixx>0.01", "<ixx>0.02").replace("<sphere><radius>0.1</radius></sphere>", BRICK)
    if "lies" in what:
        shape = shape.replace("0 0 0.6 0 0 0", "0 0 0.1 0 0 0")
    if "damps" in what:
        shape = shape.replace("</model>", DAMPED)
    if "turns" in what:
        shape = shape.replace("</model>", DAMPED.replace(">0.1<", ">0<"))
    sim = _load(tmp_path, shape + FLOOR.format(""))
    if "turns" in what:
        sim["ball"].joint("j").command_velocity(1.0)
    sim.step(5)
    assert sim.engine.save().data.efm_active == (0 if is_plain else 1)


def test_a_plain_metric_ignores_stale_memory_of_the_other_metric(tmp_path: Path) -> None:
    """MuJoCo reserves what motors add to it before the laws act, and writes it after them, if it is on."""
    positions: list[float] = []
    for remains in (0.0, 1e6):
        sim = _load(tmp_path, BALL.format(0, "").replace("</model>", DAMPED.replace(">0.1<", ">0<")))

        def leave(model: mujoco.MjModel, data: mujoco.MjData, remains: float = remains) -> None:
            del model
            data.efm_sdiag[:] = remains

        mujoco.set_mjcb_control(leave)
        try:
            sim["ball"].joint("j").command_velocity(1.0, max_effort=0.5)
            sim.step(50)
        finally:
            mujoco.set_mjcb_control(None)
        positions.append(sim["ball"].joint("j").position)
    assert positions[0] == positions[1]

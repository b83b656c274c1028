"""Batches on a GPU: what it cannot step, and states beside those of the CPU.

Without a GPU Warp runs the same kernels on its CPU device. Single precision has 6e-8; errors grow with time.
"""

from collections.abc import Callable
from importlib.metadata import packages_distributions
from importlib.util import find_spec
from pathlib import Path

import mujoco
import numpy as np
import pytest
from tests.warp_device import warp_device

import trundle
from trundle.assets import ASSETS
from trundle.base.diagnostics import UsageError
from trundle.sim.physics import Batch, NoGpuError, find_gpu, gpu_limits
from trundle.sim.physics.step.batch import part_of
from trundle.sim.simulation import Simulation

WORLDS = ASSETS / "worlds"
DEVICE = warp_device()
HAS_WARP = find_spec("warp") is not None and find_spec("mujoco_warp") is not None
needs_warp = pytest.mark.skipif(not HAS_WARP, reason="mujoco-warp is not installed: trundle doctor says how")
SHAPE = "<geometry><box><size>0.2 0.2 0.2</size></box></geometry>"
INERTIA = "<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
FLOOR = (
    '<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1</normal>'
    "</plane></geometry><surface>{}</surface></collision></link></model>"
)


@pytest.fixture
def box(tmp_path: Path) -> Callable[..., Simulation]:
    """Load a box above a floor."""

    def load(surface: str = "", link: str = "", pose: str = "0 0 0.3 0.2 0.3 0") -> Simulation:
        file = tmp_path / "box.world"
        file.write_text(
            f'<sdf version="1.6"><world name="w">{FLOOR.format(surface)}<model name="box"><pose>{pose}</pose>'
            f'<link name="l">{link}<inertial><mass>1</mass>{INERTIA}</inertial><collision name="c">{SHAPE}'
            f"<surface>{surface}</surface></collision></link></model></world></sdf>"
        )
        return trundle.load(str(file))

    return load


@pytest.mark.parametrize(
    ("surface", "link", "sentence"),
    [
        (
            "<bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0</threshold></bounce>",
            "",
            "contacts bounce (<restitution_coefficient>): ",
        ),
        (
            "<friction><ode><mu>1</mu><mu2>0.5</mu2></ode></friction>",
            "",
            "contacts have two different frictions (<mu>, <mu2>): ",
        ),
        (
            "<friction><ode><slip1>0.1</slip1></ode></friction>",
            "",
            "contacts slip under load (<slip1>, <slip2>): ",
        ),
        (
            "<contact><ode><min_depth>0.01</min_depth></ode></contact>",
            "",
            "contacts yield (<min_depth>, <max_vel>, <kp>, <kd>): ",
        ),
        (
            "",
            "<velocity_decay><linear>0.01</linear></velocity_decay>",
            "links lose a part of their speed at each step (<velocity_decay>): box::l",
        ),
    ],
)
def test_laws_missing_on_a_gpu_are_named(box, surface, link, sentence) -> None:
    (limit,) = gpu_limits(box(surface, link).engine.compiled)

    assert limit.startswith(sentence)
    assert "box::l" in limit


@pytest.mark.parametrize("name", ["arm_reach", "cart_pole", "drive_to_goal"])
def test_the_ready_made_worlds_have_no_gpu_limits(name) -> None:
    assert gpu_limits(trundle.load(str(WORLDS / f"{name}.world")).engine.compiled) == []


def test_one_package_owns_mujoco() -> None:
    """The full `mujoco`, which mujoco-warp requires, would write the same files."""
    assert set(packages_distributions()["mujoco"]) == {"mujoco-core"}


def test_without_a_gpu_the_error_says_why() -> None:
    if HAS_WARP and _has_cuda():
        assert find_gpu().startswith("cuda")
        return
    with pytest.raises(NoGpuError, match="NVIDIA GPU" if HAS_WARP else "--no-deps mujoco-warp"):
        find_gpu()


def _has_cuda() -> bool:
    import warp

    return bool(warp.is_cuda_available())


@needs_warp
@pytest.mark.slow
def test_a_world_with_a_law_that_a_gpu_lacks_is_refused(box) -> None:
    sim = box("<friction><ode><mu>1</mu><mu2>0.5</mu2></ode></friction>")

    with pytest.raises(UsageError, match="use device='cpu':\ncontacts have two different frictions"):
        sim.engine.batch(2, threads=1, gpu=DEVICE)


def _on_both(sim: Simulation, rows: int) -> tuple[Batch, Batch]:
    cpu, gpu = (sim.engine.batch(rows, threads=1, gpu=device) for device in (None, DEVICE))
    for row in range(rows):
        for batch in (cpu, gpu):
            batch.write_row(row, sim.engine.world_row())
    return cpu, gpu


def _apart(cpu: Batch, gpu: Batch) -> float:
    """Return the largest difference of poses [m or 1]; a quaternion and its negative are the same."""
    signs = np.sign((cpu.poses[..., 3:] * gpu.poses[..., 3:]).sum(axis=-1, keepdims=True))
    turned = np.abs(cpu.poses[..., 3:] - signs * gpu.poses[..., 3:])
    return float(max(np.abs(cpu.poses[..., :3] - gpu.poses[..., :3]).max(), turned.max()))


@needs_warp
@pytest.mark.slow
@pytest.mark.parametrize(
    ("world", "kind", "largest", "bound"),
    [
        # A pole that falls doubles an error every 0.2 s.
        ("cart_pole", "effort", 5.0, 2e-5),
        ("arm_reach", "velocity", 2.0, 1e-4),
        ("arm_reach", "position", 1.0, 1e-4),
    ],
)
def test_driven_joints_move_as_on_the_cpu(world, kind, largest, bound) -> None:
    sim = trundle.load(str(WORLDS / f"{world}.world"))
    cpu, gpu = _on_both(sim, 3)
    axes = [0] if kind == "effort" else [0, 1]
    start = cpu.poses.copy()
    random = np.random.default_rng(0)

    for _ in range(5):
        for axis in axes:
            values = random.uniform(-largest, largest, 3)
            for batch in (cpu, gpu):
                if kind == "effort":
                    batch.command_effort(axis, values)
                else:
                    command = batch.command_velocity if kind == "velocity" else batch.command_position
                    command(axis, values, np.inf)
        for batch in (cpu, gpu):
            batch.step(20)

    assert np.abs(cpu.poses - start).max() > 0.01
    assert not gpu.unstable.any()
    assert _apart(cpu, gpu) < bound
    assert gpu.time_s == pytest.approx(cpu.time_s)


@needs_warp
@pytest.mark.slow
@pytest.mark.parametrize(
    ("world", "wheels", "torque", "steps", "distance", "bound"),
    [
        # Wheels that spin up at once slide for a moment, in which the CPU keeps them down; steps of 10 ms, of 1 ms.
        (WORLDS / "drive_to_goal.world", ("left_joint", "right_joint"), 5.0, 200, 0.5, 0.02),
        ("model://rp2w", ("chassis_left_wheel", "chassis_right_wheel"), 2.0, 1200, 0.25, 0.003),
    ],
)
def test_wheeled_robots_drive_as_on_the_cpu(world, wheels, torque, steps, distance, bound) -> None:
    sim = trundle.load(str(world))
    cpu, gpu = _on_both(sim, 2)
    start = cpu.poses.copy()
    compiled = sim.engine.compiled
    joints = [compiled.joint_names.index(name) for name in compiled.joint_names if name.endswith(wheels)]

    for joint, speed in zip(joints, (4.0, 3.0), strict=True):
        (axis,) = compiled.joint_axes[joint]
        for batch in (cpu, gpu):
            batch.command_velocity(axis, np.full(2, speed), torque)
    for batch in (cpu, gpu):
        batch.step(steps)

    assert np.abs(cpu.poses - start)[..., :3].max() > distance
    assert _apart(cpu, gpu) < bound


@needs_warp
@pytest.mark.slow
def test_an_rp2w_follows_random_commands_as_on_the_cpu() -> None:
    """Its wheels reach their speeds at once. Its camera stands upright by friction, and falls by some commands; where
    sliding wheels hop, half of them are off by 1 to 8 cm.
    """
    sim = trundle.load("model://rp2w")
    cpu, gpu = _on_both(sim, 24)
    compiled = sim.engine.compiled
    speeds = np.random.default_rng(1).uniform(-4.0, 4.0, (24, 2))
    speeds[0] = -2.11, 0.68
    (tilt,) = compiled.joint_axes[compiled.joint_names.index("rp2w::camera_base_camera")]
    for side, column in zip(("left", "right"), speeds.T, strict=True):
        (axis,) = compiled.joint_axes[compiled.joint_names.index(f"rp2w::chassis_{side}_wheel")]
        for batch in (cpu, gpu):
            batch.command_velocity(axis, column.copy(), 2.0)

    for batch in (cpu, gpu):
        batch.step(1200)

    apart = np.abs(cpu.poses[..., :3] - gpu.poses[..., :3]).max(axis=(1, 2))
    fell = np.abs(cpu.positions([tilt])[:, 0]) > 1.0
    assert apart.max() < 0.01
    assert (apart < 0.002).sum() >= 20
    assert (np.abs(gpu.positions([tilt])[:, 0]) > 1.0).tolist() == fell.tolist()
    assert not fell[0]
    assert abs(gpu.positions([tilt])[0, 0]) < 2e-3


@needs_warp
@pytest.mark.slow
def test_a_box_falls_onto_the_floor_and_rests_as_on_the_cpu(box) -> None:
    cpu, gpu = _on_both(box(), 2)

    for batch in (cpu, gpu):
        batch.step(1500)

    # It comes to rest on a face; where it slid to depends on each bounce off an edge.
    assert cpu.poses[:, 1, 2] == pytest.approx([0.1, 0.1], abs=1e-4)
    assert gpu.poses[:, 1, 2] == pytest.approx(cpu.poses[:, 1, 2], abs=1e-4)
    assert np.abs(gpu.twists).max() < 1e-3
    assert _apart(cpu, gpu) < 0.02
    assert gpu.poses[0] == pytest.approx(gpu.poses[1], abs=1e-5)  # a GPU adds in any order


@needs_warp
@pytest.mark.slow
def test_all_convex_pairs_of_all_worlds_may_touch_at_once(tmp_path) -> None:
    """Memory for penetrations is kept for as many pairs as there are of two types, here 6 of boxes, in each world."""
    boxes = "".join(
        f'<model name="b{i}"><pose>{0.03 * i} 0 0.5 0 0 0</pose><link name="l"><inertial><mass>1</mass>{INERTIA}'
        f'</inertial><collision name="c">{SHAPE}</collision></link></model>'
        for i in range(4)
    )
    from trundle.sim.physics.step.warp.gpu_batch import GpuBatch

    file = tmp_path / "boxes.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{FLOOR.format("")}{boxes}</world></sdf>')
    sim = trundle.load(str(file))
    cpu, gpu = _on_both(sim, 3)

    for batch in (cpu, gpu):
        positions = part_of(sim.engine.compiled.model, batch.states, mujoco.mjtState.mjSTATE_QPOS)
        positions[:, ::7] = 0.03 * np.arange(4)  # inside each other again
        batch.step(2)

    assert isinstance(gpu, GpuBatch)
    assert gpu._stepper_on_gpu._data.naccdmax == 3 * 6
    for batch in (cpu, gpu):
        assert (batch.poses[:, -1, 0] - batch.poses[:, 1, 0]).min() > 0.094


@needs_warp
@pytest.mark.slow
def test_rows_not_chosen_and_unstable_rows_keep_their_state() -> None:
    sim = trundle.load(str(WORLDS / "cart_pole.world"))
    _, gpu = _on_both(sim, 3)
    gpu.command_effort(0, np.full(3, 5.0))
    gpu.states[2, 1] = np.nan
    before = gpu.states.copy()

    gpu.step(20, chosen=np.array([True, False, True]))

    assert gpu.unstable.tolist() == [False, False, True]
    assert gpu.time_s.tolist() == pytest.approx([20 * sim.step_ns / 1e9, 0.0, 0.0])
    assert np.array_equal(gpu.states[1:], before[1:], equal_nan=True)
    assert not np.array_equal(gpu.states[0], before[0])

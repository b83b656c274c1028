"""Pictures and scans per CPU second of Trundle's renderer, against software OpenGL and MuJoCo's rays."""

import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import mujoco
import numpy as np

import trundle
from bench import scenes
from bench.table import Row
from bench.tiny_renderer import TinyRenderer
from trundle.base.diagnostics import UsageError
from trundle.sim.physics import EglRenderer
from trundle.sim.physics.egl_renderer import model_from_scene
from trundle.sim.render import Intrinsics, NativeRenderer, Renderer, Scene
from trundle.sim.sensors import mount_cameras
from trundle.spatial import Pose

ROBOT = Path(__file__).parents[1] / "examples/rp2w"
_ROUNDS, _ROUND_S = 5, 0.3


def run() -> list[Row]:
    """Measure with new poses for every picture."""
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        many = scenes.meshes(Path(folder))
        few = scenes.primitives()
        for name, scene, eyes, lens in (
            ("A, 320x240", few, (scenes.EYE,), scenes.MIDDLE),
            ("B, 640x480", many, (scenes.EYE,), scenes.LARGE),
            ("C, four of 160x120", few, scenes.FOUR, scenes.SMALL),
        ):
            rows.append(_pictures(name, scene, eyes, lens))
            rows.append(_pictures(f"{name}, shadows", scenes.with_shadows(scene), eyes, lens))
        for name, scene, lens in (("A, 320x240", few, scenes.MIDDLE), ("B, 640x480", many, scenes.LARGE)):
            rows += _tiny_renderer_rows(name, scene, lens)
        for name, scene in (("A", few), ("B", many)):
            for beams, height in ((720, 1), (1800, 16)):
                rows.append(_scans(f"lidar on {name}, {height} x {beams}", scene, beams, height))
    return [*rows, *_many_cameras(), _rp2w()]


def _rate(work: Callable[[], object]) -> float:
    """Return calls per CPU second, in the best of some rounds, which is the least disturbed by other programs."""
    work()
    best = 0.0
    for _ in range(_ROUNDS):
        count, start = 0, time.process_time()
        while (elapsed := time.process_time() - start) < _ROUND_S:
            work()
            count += 1
        best = max(best, count / elapsed)
    return best


def _drawing(
    renderer: Renderer | TinyRenderer, scene: Scene, eyes: Sequence[Pose], lens: Intrinsics
) -> Callable[[], None]:
    frame = 0
    views = [(eye, lens) for eye in eyes]

    def draw() -> None:
        nonlocal frame
        frame += 1
        renderer.update(scenes.poses_at(scene, frame))
        renderer.render(views)

    return draw


def _tiny_renderer_rows(name: str, scene: Scene, lens: Intrinsics) -> list[Row]:
    """Return rows without and with shadows; none if PyBullet is not installed."""
    rows: list[Row] = []
    for title, lit in ((name, scene), (f"{name}, shadows", scenes.with_shadows(scene))):
        try:
            tiny = TinyRenderer(lit)
        except ImportError:
            return []
        rate = _rate(_drawing(NativeRenderer(lit), lit, (scenes.EYE,), lens))
        peer_rate = _rate(_drawing(tiny, lit, (scenes.EYE,), lens))
        tiny.close()
        rows.append(Row(f"render {title}", rate, "frames/s", "PyBullet TinyRenderer", rate / peer_rate))
    return rows


def _pictures(name: str, scene: Scene, eyes: Sequence[Pose], lens: Intrinsics) -> Row:
    rate = _rate(_drawing(NativeRenderer(scene), scene, eyes, lens))
    try:
        # Trundle's shadow maps are fitted to the shadow casters: this scene's has 512 pixels over 4 m.
        peer = EglRenderer(scene, shadow_radius_m=2.0, shadow_px=512)
        peer_rate: float | None = _rate(_drawing(peer, scene, eyes, lens))
    except UsageError:
        peer_rate = None
    ratio = None if peer_rate is None else rate / peer_rate
    has_shadows = any(light.casts_shadows for light in scene.lights)
    against = "MuJoCo EGL, shadow map of 512 px as in Trundle" if has_shadows else "MuJoCo EGL"
    return Row(f"render {name}", rate, "frames/s", against, ratio)


def _scans(name: str, scene: Scene, beams: int, height: int) -> Row:
    rows = np.linspace(-0.3, 0.3, height) if height > 1 else np.zeros(1)
    yaw, pitch = np.meshgrid(np.linspace(-np.pi, np.pi, beams), rows)
    directions = np.stack([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)], axis=-1).reshape(
        -1, 3
    )
    renderer, eye = NativeRenderer(scene), Pose((0.0, 0.0, 0.5))
    poses = scenes.poses_at(scene, 0)
    renderer.update(poses)
    model = model_from_scene(scene)
    data = mujoco.MjData(model)
    for i, pose in enumerate(poses):
        data.mocap_pos[i], data.mocap_quat[i] = pose[:3], pose[3:]
    mujoco.mj_forward(model, data)
    geoms, ranges = np.empty(len(directions), dtype=np.int32), np.empty(len(directions))
    flat, origin = directions.reshape(-1), np.array(eye.position)
    rate = _rate(lambda: renderer.cast(eye, directions, max_range_m=30.0))
    peer_rate = _rate(
        lambda: mujoco.mj_multiRay(model, data, origin, flat, None, 1, -1, geoms, ranges, None, len(directions), 30.0)
    )
    return Row(name, rate, "scans/s", "mj_multiRay", rate / peer_rate)


def _many_cameras() -> list[Row]:
    """Compare the frame rates of 12 and 24 cameras of 160x120 [1/s]; the cost should double."""
    scene = scenes.with_shadows(scenes.primitives())
    renderer = NativeRenderer(scene)

    def rate(count: int) -> float:
        eyes = [Pose.from_rpy(0.0, 0.0, 1.5, 0.0, 0.2, 2 * np.pi * i / count) for i in range(count)]
        return _rate(_drawing(renderer, scene, eyes, scenes.SMALL))

    few, many = rate(12), rate(24)
    return [Row("render 24 cameras of 160x120, shadows", many, "instants/s", "12 cameras", many / few)]


def _rp2w() -> Row:
    """Return simulated seconds per CPU second with both cameras at 30 Hz."""
    sim = trundle.load(str(ROBOT))
    cameras = mount_cameras(sim, NativeRenderer)
    for camera in cameras:
        sim.add_hook(camera, period_ns=camera.period_ns, enabled=lambda: True)
    sim.run(1.0)
    start = time.process_time()
    sim.run(20.0)
    return Row("RP2W, two cameras at 30 Hz, shadows", 20.0 / (time.process_time() - start), "times real time", "", None)

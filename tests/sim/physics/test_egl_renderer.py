"""OpenGL's picture of a scene against Trundle's: equal, except at the edges of rasterised round shapes."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh
from msgspec.structs import replace
from tests.pictures import drawn

from trundle.base.diagnostics import UsageError
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Rgba, Sphere
from trundle.sim.physics import EglRenderer
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, SceneLight, Shape, ShapeGeometry
from trundle.spatial import Pose

LENS = Intrinsics(width_px=320, height_px=240, horizontal_fov_rad=1.047, near_m=0.1, far_m=50.0)
EYE = Pose.from_rpy(-4.0, 0.4, 2.0, 0.0, 0.3, -0.1)
SUN = SceneLight(direction=(0.48, -0.36, -0.8), diffuse=(0.6, 0.6, 0.6, 1.0), specular=(0.0, 0.0, 0.0, 1.0))


def shape(geometry: ShapeGeometry, x: float, y: float, z: float, rgba: Rgba, turn: float = 0.0) -> Shape:
    pose = Pose.from_rpy(x, y, z, turn, turn / 3, turn / 2)
    return Shape(name="s", body=0, geometry=geometry, body_from_shape=pose, rgba=rgba)


def ball() -> Mesh:
    sphere = trimesh.creation.icosphere(subdivisions=5, radius=0.45)
    return Mesh(sphere.vertices.astype(np.float32), sphere.faces.astype(np.int32))


SHAPES = (
    shape(Plane((0.0, 0.0, 1.0), (0.0, 0.0)), 0.0, 0.0, 0.0, (0.6, 0.6, 0.5, 1.0)),
    shape(Box((0.5, 0.6, 0.7)), 0.0, 1.2, 0.35, (0.9, 0.2, 0.2, 1.0), 0.3),
    shape(Sphere(0.4), 0.8, 0.4, 0.4, (0.2, 0.8, 0.3, 1.0)),
    shape(Cylinder(0.25, 0.9), 0.2, -0.4, 0.55, (0.2, 0.3, 0.9, 1.0), 0.2),
    shape(Capsule(0.15, 0.5), -0.9, 0.4, 0.4, (0.9, 0.8, 0.2, 1.0), 1.0),
    shape(Ellipsoid((0.5, 0.2, 0.3)), -0.8, -0.8, 0.4, (0.7, 0.2, 0.8, 1.0), 0.4),
    shape(ball(), 0.6, -1.5, 0.5, (0.3, 0.7, 0.8, 1.0)),
)


def scene(light: SceneLight = SUN) -> Scene:
    return Scene(
        bodies=("b",), shapes=SHAPES, lights=(light,), ambient=(0.3, 0.3, 0.3, 1.0), background=(0.4, 0.5, 0.6, 1.0)
    )


@pytest.fixture(scope="module")
def opengl() -> EglRenderer:
    try:
        return EglRenderer(scene())
    except UsageError as error:
        pytest.skip(str(error))


def test_colors_depths_and_segmentation_agree_with_opengl(opengl: EglRenderer) -> None:
    native = NativeRenderer(scene())
    pictures = []
    for renderer in (native, opengl):
        renderer.update(np.array([[0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
        pictures.append(drawn(renderer, EYE, LENS, depth=True, segmentation=True))
    a, b = pictures
    assert a.depth is not None
    assert b.depth is not None
    assert a.segmentation is not None
    assert b.segmentation is not None
    assert np.abs(a.rgb.astype(float) - b.rgb).mean() <= 1.0
    other = a.segmentation != b.segmentation
    assert other.mean() <= 0.001  # OpenGL draws round shapes as polyhedra
    both = np.isfinite(a.depth) & np.isfinite(b.depth) & ~other
    flat = both & np.isin(a.segmentation, (0, 1))
    assert both.mean() > 0.5
    assert np.median(np.abs(a.depth[flat] - b.depth[flat])) <= 1e-5
    assert set(np.unique(b.segmentation)) == {*range(len(SHAPES)), -1}


def test_shadows_of_the_sun_agree_with_the_native_renderer() -> None:
    """Shadow of a box three metres from the origin: OpenGL's floor is dark where Trundle's is."""
    floor = shape(Plane((0.0, 0.0, 1.0), (20.0, 20.0)), 0.0, 0.0, 0.0, (1.0, 1.0, 1.0, 1.0))
    box = shape(Box((1.0, 1.0, 1.0)), 3.0, 1.0, 0.5, (1.0, 0.0, 0.0, 1.0))
    sun = replace(SUN, casts_shadows=True, position=(0.0, 0.0, 10.0))
    lit_scene = Scene(bodies=("b",), shapes=(floor, box), lights=(sun,))
    try:
        renderers = (NativeRenderer(lit_scene), EglRenderer(lit_scene))
    except UsageError as error:
        pytest.skip(str(error))
    above = Pose.from_rpy(3.0, 0.0, 9.0, 0.0, math.pi / 2, 0.0)
    dark: list[np.ndarray] = []
    for renderer in renderers:
        renderer.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
        picture = drawn(renderer, above, LENS, segmentation=True)
        green = picture.rgb[..., 1].astype(int)
        dark.append((picture.segmentation == 0) & (green < green.max() - 30))
    native, egl = dark
    assert native.sum() > 100
    assert (native != egl).sum() <= 0.15 * native.sum()


def test_a_deformed_mesh_is_drawn_as_by_the_native_renderer(opengl: EglRenderer) -> None:
    mesh = SHAPES[-1].geometry
    assert isinstance(mesh, Mesh)
    native = NativeRenderer(scene())
    depths = []
    for renderer in (native, opengl):
        renderer.update(np.array([[0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
        renderer.set_vertices(len(SHAPES) - 1, mesh.vertices * np.array([1.5, 0.3, 0.7], dtype=np.float32))
        picture = drawn(renderer, EYE, LENS, depth=True, segmentation=True)
        assert picture.depth is not None
        assert picture.segmentation is not None
        depths.append(np.where(picture.segmentation == len(SHAPES) - 1, picture.depth, np.nan))
    opengl.set_vertices(len(SHAPES) - 1, mesh.vertices)

    assert (np.isnan(depths[0]) != np.isnan(depths[1])).mean() <= 0.001
    assert np.nanmedian(np.abs(depths[0] - depths[1])) <= 1e-4


def test_a_body_without_a_pose_is_not_drawn(opengl: EglRenderer) -> None:
    opengl.update(np.full((1, 7), math.nan))
    picture = drawn(opengl, EYE, LENS, segmentation=True)
    assert picture.segmentation is not None
    assert (picture.segmentation == -1).all()
    assert (picture.rgb == [102, 128, 153]).all()


def test_without_opengl_the_error_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco.egl", None)
    with pytest.raises(UsageError, match=r"no OpenGL over EGL here .*--renderer cpu works without"):
        EglRenderer(scene())


HIDDEN = """
import ctypes, ctypes.util
load, find = ctypes.CDLL.__init__, ctypes.util.find_library
def hide(self, name, *args, **kwargs):
    if "EGL" in str(name):
        raise OSError(f"{name}: cannot open shared object file")
    load(self, name, *args, **kwargs)
ctypes.CDLL.__init__ = hide
ctypes.util.find_library = lambda name: None if "EGL" in name else find(name)
"""


def test_without_the_library_rendering_ends_with_one_message(tmp_path: Path) -> None:
    """A separate process, in which libEGL is missing."""
    (tmp_path / "sitecustomize.py").write_text(HIDDEN)
    ball = '<visual name="v"><geometry><sphere><radius>1</radius></sphere></geometry></visual>'
    (tmp_path / "m.sdf").write_text(f'<sdf version="1.6"><model name="m"><link name="l">{ball}</link></model></sdf>')
    command = [sys.executable, "-m", "trundle", "render", "m.sdf", "-o", "m.png", "--renderer", "egl"]
    ended = subprocess.run(
        command, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path)}, capture_output=True, text=True
    )

    assert ended.returncode == 1
    (sentence,) = ended.stderr.splitlines()
    assert sentence.startswith("trundle render: error: no OpenGL over EGL here (")
    assert "has no attribute" not in sentence
    assert not (tmp_path / "m.png").exists()

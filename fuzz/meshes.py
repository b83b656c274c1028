"""Meshes: accepted meshes are rendered, and checked as collision and visual of a model."""

import json
import zlib
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from PIL import Image
from trimesh.visual import TextureVisuals

from trundle.gazebo.check.check_file import check
from trundle.robots.meshes import Mesh, load_mesh, load_motion, load_skin
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, Shape
from trundle.spatial import Pose

from .seeds import picture, seed
from .target import Execute, Open, Target, reads_file, write_file

_CHECK_PERIOD = 8
"""One of this number of accepted meshes is also compiled, selected by the input's checksum."""
_DAE_WORDS = (
    b"Y_UP", b"1e9", b"<scale>0 1 1</scale>", b"<skew>1 2 3 4 5 6 7</skew>", b"<lookat>0 0 0 0 0 0 0 0 0</lookat>",
    b"polygons", b"tristrips", b"trifans", b"lines", b"<instance_node url='#n1'/>", b"#quad-mesh", b"#p", b"NORMAL",
    b"JOINT",
)  # fmt: skip
_GLB_WORDS = (
    b'"byteOffset":', b'"byteStride":', b'"sparse":', b'"count":', b'"componentType":', b'"mode":', b'"children":[0]',
    b'"matrix":', b'"uri":"data:,"', b'"extensionsRequired":', b'"scale":[0,0,0]',
)  # fmt: skip
_VIEWS = [
    (Pose((x, 0.0, 0.5)), Intrinsics(width_px=16, height_px=12, horizontal_fov_rad=1.0, near_m=0.01))
    for x in (-3.0, 0.0)
]


def _draw(mesh: Mesh) -> None:
    scene = Scene(bodies=("m",), shapes=(Shape(name="m", body=0, geometry=mesh),))
    renderer = NativeRenderer(scene)
    renderer.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    renderer.render(_VIEWS, depth=True, segmentation=True)
    renderer.cast(Pose((-3.0, 0.0, 0.5)), np.array([[1.0, 0.0, 0.0], [0.6, 0.8, 0.0]]), max_range_m=30.0)


def _meshes(name: str) -> Open:
    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        file = folder / name
        (folder / "car.mtl").write_bytes(seed("car.mtl"))
        (folder / "paint.png").write_bytes(picture("PNG"))
        shape = f"<geometry><mesh><uri>{name}</uri></mesh></geometry>"
        link = f"<link name='l'><collision name='c'>{shape}</collision><visual name='v'>{shape}</visual></link>"
        (folder / "model.sdf").write_text(f"<sdf version='1.6'><model name='m'>{link}</model></sdf>")

        def execute(data: bytes) -> None:
            write_file(file, data)
            mesh = load_mesh(file)
            _draw(mesh)
            if zlib.crc32(data) % _CHECK_PERIOD == 0:
                json.dumps(check(str(folder / "model.sdf"), {}, start=folder).as_json(), allow_nan=False)

        yield execute

    return opened


def _read_skin(file: Path) -> None:
    skin, motion = load_skin(file), load_motion(file)
    for time_s in (0.0, 0.7):
        skin.vertices(motion.poses(time_s, 1.0))


def _exported(kind: str, *, texture: bool = False) -> bytes:
    shape: Any = trimesh.creation.box()
    if texture:
        uv = np.zeros((len(shape.vertices), 2))
        shape.visual = TextureVisuals(uv=uv, image=Image.new("RGB", (2, 2)))
    data = shape.export(file_type=kind)
    return data if isinstance(data, bytes) else data.encode()


TARGETS = {
    "stl": Target(
        open=_meshes("m.stl"),
        seeds=lambda: [_exported("stl"), _exported("stl_ascii")],
        words=(b"facet normal", b"outer loop", b"vertex", b"endloop", b"endfacet", b"endsolid"),
        corpus=("repos/**/*.stl", "repos/**/*.STL"),
    ),
    "obj": Target(
        open=_meshes("m.obj"),
        seeds=lambda: [seed("car.obj"), _exported("obj")],
        words=(
            b"f 1/1/1 2/2/2 3/3/3",
            b"f -1 -2 -3",
            b"f 1//1 2//2 3//3",
            b"usemtl red",
            b"vn 0 0 1",
            b"vp",
            b"s off",
            b"g a",
        ),
    ),
    "dae": Target(
        open=_meshes("m.dae"),
        seeds=lambda: [seed("nodes.dae")],
        words=_DAE_WORDS,
        corpus=("repos/**/*.dae", "repos/**/*.DAE"),
    ),
    "glb": Target(
        open=_meshes("m.glb"),
        seeds=lambda: [_exported("glb"), _exported("glb", texture=True)],
        words=_GLB_WORDS,
    ),
    "skin": Target(open=reads_file("s.dae", _read_skin), seeds=lambda: [seed("skin.dae")], words=_DAE_WORDS),
    "bvh": Target(
        open=reads_file("m.bvh", load_motion),
        seeds=lambda: [seed("motion.bvh")],
        words=(b"JOINT", b"End Site", b"OFFSET", b"CHANNELS 3", b"Frames:", b"Frame Time:", b"{", b"}"),
    ),
}

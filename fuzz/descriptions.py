"""Descriptions: `trundle check`, and worlds that are rendered and stepped."""

import json
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.gazebo.check.check_file import check
from trundle.robots.packages import Packages, run_dependencies
from trundle.sim.render import Intrinsics, NativeRenderer, scene_from_world
from trundle.spatial import Pose

from .seeds import picture, seed
from .target import Execute, Open, Target, write_file

_SDF_WORDS = (
    b"world", b"__model__", b"model://m", b"m::a", b"n::b", b"ball", b"gearbox", b"screw", b"universal", b"floating",
    b"1.4", b"1.11", b"1 0 0 0 0 0 1", b"0 0 0 1.57 0 0", b"<include><uri>model://m</uri></include>",
    b"<sensor name='s' type='gpu_ray'>", b"<actor name='a'>", b"<heightmap><uri>h.png</uri></heightmap>",
    b"<mesh><uri>m.stl</uri></mesh>", b"<plugin name='p' filename='libgazebo_ros_diff_drive.so'/>",
    b"<static>1</static>",
)  # fmt: skip
_XACRO_WORDS = (
    b"${range(9)}", b"${[x for x in range(9)]}", b"${'a' * 9}", b"${dict(a=1)}", b"${load_yaml('p.yaml')}", b"$(arg n)",
    b"$(eval 1+1)", b"$(cwd)", b"$(optenv A b)", b"xacro:include", b"xacro:call", b"xacro:attribute", b"**block",
    b"${sqrt(-1)}", b"${1 << 99}", b"${'%9999d' % 1}", b"${xacro.arg('n')}",
)  # fmt: skip


def _checks(name: str) -> Open:
    """Return an `open` that checks a file like `trundle check` with every option."""

    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        file = folder / name
        (folder / "p.yaml").write_bytes(seed("parameters.yaml"))
        (folder / "h.png").write_bytes(picture("PNG", "L"))
        (folder / "m.stl").write_bytes(b"solid x\nendsolid x\n")
        if name == "model.config":
            (folder / "model.sdf").write_bytes(seed("model.sdf"))

        def execute(data: bytes) -> None:
            write_file(file, data)
            result = check(str(folder if name == "model.config" else file), {"HOME": str(folder)}, start=folder)
            json.dumps(result.as_json(), allow_nan=False)
            result.text()
            result.trees()
            assert all("\n" not in finding.what for finding in result.report.findings), "a finding is one line"

        yield execute

    return opened


@contextmanager
def _open_package(folder: Path) -> Generator[Execute]:
    """Read a package's manifest in all uses."""

    def execute(data: bytes) -> None:
        write_file(folder / "package.xml", data)
        packages = Packages({"ROS_PACKAGE_PATH": str(folder)}, start=folder)
        packages.find_package("p")
        packages.worlds()
        packages.material_folders()
        run_dependencies(folder)

    yield execute


@contextmanager
def _open_material(folder: Path) -> Generator[Execute]:
    """Read an Ogre script through a visual with its material."""
    script = "<script><uri>fuzz.material</uri><name>Fuzz/Paint</name></script>"
    shape = "<geometry><sphere><radius>1</radius></sphere></geometry>"
    visual = f"<visual name='v'>{shape}<material>{script}</material></visual>"
    (folder / "model.sdf").write_text(
        f"<sdf version='1.6'><model name='m'><link name='l'>{visual}</link></model></sdf>"
    )
    (folder / "sign.png").write_bytes(picture("PNG"))

    def execute(data: bytes) -> None:
        write_file(folder / "fuzz.material", data)
        json.dumps(check(str(folder / "model.sdf"), {}, start=folder).as_json(), allow_nan=False)

    yield execute


@contextmanager
def _open_scene(folder: Path) -> Generator[Execute]:
    """Load a world, step it, and render it from two sides."""
    lens = Intrinsics(width_px=32, height_px=24, horizontal_fov_rad=1.2)
    views = [(Pose((-2.0, 0.0, 0.5)), lens), (Pose((0.0, 0.0, 0.01)), lens)]

    def execute(data: bytes) -> None:
        file = folder / "scene.sdf"
        write_file(file, data)
        simulation = trundle.load(file)
        renderer = NativeRenderer(scene_from_world(simulation.world, Diagnostics()))
        for _ in range(3):
            simulation.step(5)
            renderer.update(simulation.snapshot().poses)
            renderer.render(views, depth=True, segmentation=True)

    yield execute


TARGETS = {
    "sdf": Target(
        open=_checks("model.sdf"),
        seeds=lambda: [seed("model.sdf"), seed("scene.sdf")],
        words=_SDF_WORDS,
        corpus=("invalid/sdf/**/*", "repos/**/*.sdf", "repos/**/*.world"),
    ),
    "urdf": Target(
        open=_checks("robot.urdf"),
        seeds=lambda: [seed("model.urdf")],
        words=(b"continuous", b"planar", b"mimic", b"<gazebo>", b"transmission", *_SDF_WORDS[:4]),
        corpus=("invalid/urdf/**/*", "repos/**/*.urdf"),
    ),
    "xacro": Target(
        open=_checks("robot.urdf.xacro"),
        seeds=lambda: [seed("robot.xacro")],
        words=_XACRO_WORDS,
        corpus=("invalid/xacro/**/*", "repos/**/*.xacro"),
    ),
    "model.config": Target(
        open=_checks("model.config"),
        seeds=lambda: [seed("model.config")],
        corpus=("repos/**/model.config",),
    ),
    "package.xml": Target(
        open=_open_package,
        seeds=lambda: [seed("package.xml")],
        corpus=("repos/**/package.xml",),
    ),
    "material": Target(
        open=_open_material,
        seeds=lambda: [seed("material.material")],
        words=(b"import *", b"set $a", b"texture_unit", b"abstract", b"{", b"}", b"//", b"/*"),
        corpus=("repos/**/*.material",),
    ),
    "scene": Target(open=_open_scene, seeds=lambda: [seed("scene.sdf"), seed("model.sdf")], words=_SDF_WORDS),
}

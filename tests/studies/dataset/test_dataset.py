"""Datasets by the whole path: plan, command, files."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from trundle.base.diagnostics import UsageError
from trundle.studies.dataset.dataset_digest import dataset_digest
from trundle.studies.dataset.dataset_world import picture_maker
from trundle.studies.datasets import DatasetFolder, load_dataset_plan
from trundle.studies.datasets.annotation import Mask
from trundle.studies.datasets.run_length import decode_mask

TRUNDLE = Path(sys.executable).with_name("trundle")
WORLD = """<sdf version="1.6"><world name="w"><model name="floor"><static>1</static><link name="l">
<collision name="c"><geometry><box><size>4 4 0.1</size></box></geometry></collision>
<visual name="v"><geometry><box><size>4 4 0.1</size></box></geometry></visual></link></model></world></sdf>"""
MODEL = """<sdf version="1.6"><model name="m"><link name="body">
<collision name="c"><geometry>{shape}</geometry></collision>
<visual name="v"><geometry>{shape}</geometry></visual></link></model></sdf>"""
PLAN = """\
world: world.sdf
count: 3
seed: 5
size: [160, 120]
camera: {orbit: {distance: {uniform: [2, 3]}, elevation: {uniform: [0.4, 1.2]}}}
objects:
  box: {model: box.sdf, surface: floor, within: {x: [-1, 1], y: [-1, 1]}, key_points: {top: [0, 0, 0.2]}, color: any}
  ball: {model: ball.sdf, count: [1, 2], surface: floor, within: {x: [-1, 1], y: [-1, 1]}}
distractors: {count: {uniform: [0, 3]}, size: {uniform: [0.1, 0.3]}, surface: floor, color: any}
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    (tmp_path / "world.sdf").write_text(WORLD)
    (tmp_path / "box.sdf").write_text(MODEL.format(shape="<box><size>0.4 0.4 0.4</size></box>"))
    (tmp_path / "ball.sdf").write_text(MODEL.format(shape="<sphere><radius>0.2</radius></sphere>"))
    (tmp_path / "plan.yaml").write_text(PLAN)
    return tmp_path / "plan.yaml"


def _make(plan: Path, *options: str) -> subprocess.CompletedProcess[str]:
    command = [TRUNDLE, "dataset", plan, *options]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)


def _bytes(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning")  # in its compiled part
def test_coco_is_what_cocos_tools_read(plan: Path) -> None:
    coco = pytest.importorskip("pycocotools.coco", reason="pycocotools is not installed")

    done = _make(plan)

    folder = plan.with_suffix(".dataset")
    assert (done.returncode, done.stdout) == (0, f"3 of 3 pictures; {folder}\n"), done.stderr
    read = coco.COCO(str(folder / "coco.json"))
    assert {category["name"] for category in read.loadCats(read.getCatIds())} == {"box", "ball"}
    assert len(read.getImgIds()) == 3
    assert len(read.getAnnIds()) >= 6
    for image in read.loadImgs(read.getImgIds()):
        with Image.open(folder / image["file_name"]) as picture:
            assert (picture.size, picture.mode) == ((160, 120), "RGB")
        numbers = np.array(Image.open(folder / "segmentation" / Path(image["file_name"]).name))
        for annotation in read.loadAnns(read.getAnnIds(image["id"])):
            mask = read.annToMask(annotation).astype(bool)
            (number,) = np.unique(numbers[mask])
            assert np.array_equal(numbers == number, mask), "one instance, all of it"
            rows, columns = np.nonzero(mask)
            x, y, width, height = annotation["bbox"]
            assert (x, y, x + width, y + height) == (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
            assert annotation["area"] == mask.sum()


@pytest.mark.slow
def test_existing_images_are_kept_and_the_rest_is_the_same(plan: Path) -> None:
    assert _make(plan, "-o", str(plan.with_name("whole"))).returncode == 0
    whole, folder = plan.with_name("whole"), plan.with_suffix(".dataset")

    assert _make(plan, "--count", "1").stdout.startswith("1 of 1 pictures; ")
    before = (folder / "images/000000.png").stat().st_mtime_ns
    assert _make(plan).returncode == 0

    assert (folder / "images/000000.png").stat().st_mtime_ns == before
    assert _bytes(folder) == _bytes(whole)


@pytest.mark.slow
def test_another_plan_does_not_write_into_the_folder(plan: Path) -> None:
    assert _make(plan, "--count", "1").returncode == 0
    plan.write_text(PLAN.replace("seed: 5", "seed: 6"))

    done = _make(plan, "--count", "1")

    assert done.returncode == 1
    assert "has the pictures of another plan, or the plan, its world or its models have changed since" in done.stderr
    (plan.with_suffix(".dataset") / "plan.json").write_text("{")
    assert "has the pictures of another plan" in _make(plan, "--count", "1").stderr


def _with_files(folder: Path, *, includes: bool) -> Path:
    """Write a plan whose object is a xacro robot with an included file, a mesh with a material library and a texture,
    or a model that includes another one.
    """
    mesh = "mtllib part.mtl\nv 0 0 0\nv .2 0 0\nv 0 .2 0\nv 0 0 .2\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\n"
    faces = "".join(f"f {a}/1 {b}/2 {c}/3\n" for a, b, c in ((1, 3, 2), (1, 2, 4), (2, 3, 4), (1, 4, 3)))
    (folder / "part.obj").write_text(mesh + faces)
    (folder / "part.mtl").write_text("newmtl red\nKd 1 0 0\nmap_Kd red.png\n")
    Image.new("RGB", (8, 8), (200, 10, 10)).save(folder / "red.png")
    xacro = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    (folder / "size.xacro").write_text(f'<robot {xacro}><xacro:property name="mass" value="1"/></robot>')
    shape = f'<geometry><mesh filename="file://{folder}/part.obj"/></geometry>'
    inertia = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    link = f'<link name="l"><inertial><mass value="${{mass}}"/>{inertia}</inertial><visual>{shape}</visual></link>'
    include = f'<xacro:include filename="{folder}/size.xacro"/>'
    (folder / "robot.xacro").write_text(f'<robot name="r" {xacro}>{include}{link}</robot>')
    ball = "<geometry><sphere><radius>0.1</radius></sphere></geometry>"
    (folder / "ball.sdf").write_text(
        f'<sdf version="1.6"><model name="b"><link name="l"><visual name="v">{ball}</visual></link></model></sdf>'
    )
    (folder / "outer.sdf").write_text(
        f'<sdf version="1.6"><model name="o"><include><uri>file://{folder}/ball.sdf</uri></include></model></sdf>'
    )
    (folder / "plan.yaml").write_text(f"""\
world: empty.world
count: 1
size: [64, 48]
camera: {{position: [1, 1, 1]}}
objects: {{o: {{model: {"outer.sdf" if includes else "robot.xacro"}, position: [0, 0, 1]}}}}
""")
    return folder / "plan.yaml"


@pytest.mark.parametrize(
    ("name", "changed", "by"),
    [
        ("part.obj", "v .2 0 0", "v .3 0 0"),
        ("part.mtl", "Kd 1 0 0", "Kd 0 1 0"),
        ("red.png", "", ""),
        ("size.xacro", 'value="1"', 'value="2"'),
        ("ball.sdf", "0.1", "0.2"),
    ],
)
def test_a_dataset_does_not_go_on_with_a_changed_file(tmp_path: Path, name: str, changed: str, by: str) -> None:
    """Included xacro files and models, meshes, their materials and textures: by their content."""
    plan = load_dataset_plan(_with_files(tmp_path, includes=name == "ball.sdf"))
    folder = DatasetFolder(tmp_path / "out")
    folder.open(plan, dataset_digest(picture_maker(plan)))
    folder.open(plan, dataset_digest(picture_maker(plan)))

    if name == "red.png":
        Image.new("RGB", (8, 8), (10, 10, 200)).save(tmp_path / name)
    else:
        text = (tmp_path / name).read_text()
        assert changed in text
        (tmp_path / name).write_text(text.replace(changed, by))

    with pytest.raises(UsageError, match="or the plan, its world or its models have changed since"):
        folder.open(plan, dataset_digest(picture_maker(plan)))


@pytest.mark.slow
def test_records_have_masks_by_number(plan: Path) -> None:
    _make(plan, "--count", "1")
    record = json.loads((plan.with_suffix(".dataset") / "records/000000.json").read_text())
    numbers = np.array(Image.open(plan.with_suffix(".dataset") / "segmentation/000000.png"))
    for annotation in record["objects"]:
        mask = Mask(size=tuple(annotation["mask"]["size"]), counts=annotation["mask"]["counts"])
        assert np.array_equal(decode_mask(mask), numbers == annotation["instance"])


@pytest.mark.slow
def test_a_killed_dataset_goes_on_and_its_files_are_the_same(plan: Path) -> None:
    plan.write_text(PLAN.replace("count: 3", "count: 40\nformats: [coco, yolo, kitti]"))
    whole, folder = plan.with_name("whole"), plan.with_suffix(".dataset")
    assert _make(plan, "-o", str(whole), "--workers", "1").returncode == 0

    process = subprocess.Popen([TRUNDLE, "dataset", plan], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 120
    while process.poll() is None and time.monotonic() < deadline:
        if len(list(folder.glob("records/*.json"))) >= 7:
            break
        time.sleep(0.005)
    process.kill()
    process.wait()
    modified_at = {path: path.stat().st_mtime_ns for path in folder.glob("records/*.json")}
    assert 7 <= len(modified_at) < 40
    again = _make(plan)

    assert again.returncode == 0, again.stderr
    assert {path: path.stat().st_mtime_ns for path in modified_at} == modified_at, "nothing is made twice"
    assert _bytes(folder) == _bytes(whole)


@pytest.mark.slow
def test_show_draws_one_picture_and_makes_no_dataset(plan: Path) -> None:
    done = _make(plan, "--show", "2")

    path = plan.with_suffix(".000002.png")
    lines = done.stdout.splitlines()
    assert lines[0].endswith(" objects")
    assert "(box): " in lines[1]
    assert lines[-1] == str(path)
    with Image.open(path) as image:
        assert image.size == (320, 240)
    assert not plan.with_suffix(".dataset").exists()
    assert "the plan has pictures 0 to 2" in _make(plan, "--show", "3").stderr

"""Skins on bones: vertices over time, and refused files."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from tests.skinned import bending_column

from trundle.robots.meshes import MeshError, Motion, Skin, load_motion, load_skin, match_bones

HALF = math.sqrt(0.5)


def read(folder: Path, text: str) -> tuple[Skin, Motion]:
    file = folder / "column.dae"
    file.write_text(text)
    return load_skin(file), load_motion(file)


def test_a_skin_at_rest_is_its_mesh(tmp_path: Path) -> None:
    skin, _ = read(tmp_path, bending_column())

    assert_allclose(skin.vertices({}), skin.mesh.vertices, atol=1e-6)
    assert len(skin.mesh.vertices) == 20


@pytest.mark.parametrize(
    ("time_s", "angle", "along"),
    [(0.0, 0.0, 0.0), (0.5, math.pi / 4, 0.5), (1.0, math.pi / 2, 1.0), (2.5, math.pi / 4, 0.5)],
)
def test_the_upper_half_turns_about_its_bone(tmp_path: Path, time_s: float, angle: float, along: float) -> None:
    """After 2 s it begins again; between two times turns go along an arc."""
    skin, motion = read(tmp_path, bending_column())

    vertices = skin.vertices(motion.poses(time_s, 1.0))

    rest = skin.mesh.vertices
    y, z = rest[:, 1], rest[:, 2] - 1.0
    turned = np.stack(
        [rest[:, 0] + along, y * math.cos(angle) - z * math.sin(angle), 1 + y * math.sin(angle) + z * math.cos(angle)],
        axis=1,
    )
    upper, lower = rest[:, 2] > 1.0, rest[:, 2] < 1.0
    assert_allclose(vertices[upper], turned[upper], atol=1e-6)
    assert_allclose(vertices[lower], rest[lower] + (along, 0, 0), atol=1e-6)
    middle = ~upper & ~lower
    assert_allclose(vertices[middle], (turned[middle] + rest[middle] + (along, 0, 0)) / 2, atol=1e-6)


def test_an_animation_gives_the_distance_covered_over_time(tmp_path: Path) -> None:
    _, motion = read(tmp_path, bending_column(times=(0.0, 1.0, 4.0)))

    assert motion.length_s == 4.0
    assert [motion.time_at(distance, 1.0) for distance in (0.5, 1.5, 2.5, 9.0)] == [0.5, 2.5, 0.5, 1.0]
    assert motion.time_at(1.0, 2.0) == 0.5


def test_single_angles_and_offsets_are_animated(tmp_path: Path) -> None:
    """Some exporters write a joint as rotations about three axes, and a channel for each number."""
    text = bending_column()
    text = re.sub(
        r'(<node id="tip"[^>]*>)\s*<matrix sid="transform">[^<]*</matrix>',
        r'\1<translate sid="location">0 0 1</translate><rotate sid="turn">1 0 0 0</rotate>',
        text,
    )
    text = re.sub(
        r'<source id="tip-p">.*?</source>',
        '<source id="tip-p"><float_array>0 90 0</float_array></source>',
        text,
        flags=re.DOTALL,
    ).replace('target="tip/transform"', 'target="tip/turn.ANGLE"')
    skin, motion = read(tmp_path, text)

    top = skin.vertices(motion.poses(0.5, 1.0))[-4:].mean(axis=0)

    assert_allclose(top, (0.5, -HALF, 1 + HALF), atol=1e-6)


BVH = """HIERARCHY
ROOT root { OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT tip { OFFSET 0 0 1 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 0 1 } } }
MOTION
Frames: 2
Frame Time: 0.5
0 0 0 0 0 0 0 0 0
1 0 0 0 0 0 0 90 0
"""


def test_motion_capture_moves_a_skin(tmp_path: Path) -> None:
    skin, _ = read(tmp_path, bending_column())
    (tmp_path / "m.bvh").write_text(BVH)
    motion = load_motion(tmp_path / "m.bvh")
    bones = match_bones(skin.bones, motion.bones)
    assert bones is not None

    poses = {bones[number]: pose for number, pose in motion.poses(0.25, 1.0).items()}

    assert motion.length_s == 0.5
    assert_allclose(skin.vertices(poses)[-4:].mean(axis=0), (0.5, -HALF, 1 + HALF), atol=1e-6)


def test_skeletons_fit_by_name_or_else_by_how_they_branch(tmp_path: Path) -> None:
    skin, _ = read(tmp_path, bending_column())
    (tmp_path / "m.bvh").write_text(BVH.replace("root", "Hips").replace("tip", "Spine"))
    (tmp_path / "other.bvh").write_text(BVH.replace("JOINT tip {", "JOINT tip { OFFSET 0 0 1 JOINT more {", 1) + "}")

    assert match_bones(skin.bones, load_motion(tmp_path / "m.bvh").bones) == {0: 1, 1: 2}
    with pytest.raises(MeshError):
        load_motion(tmp_path / "other.bvh")
    two = BVH.replace("End Site { OFFSET 0 0 1 }", "JOINT more { OFFSET 0 0 1 CHANNELS 0 }")
    (tmp_path / "other.bvh").write_text(two)
    assert match_bones(skin.bones, load_motion(tmp_path / "other.bvh").bones) is None


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (("root tip</Name", "root lost</Name"), "its skin is bound to 'lost', which is not a bone in it"),
        (("<skeleton>", "<bones>"), r"line \d+: not well-formed XML: </skeleton> does not match <bones> "),
        (('<controller id="c">', '<controller id="d">'), "no mesh in it is bound to bones"),
    ],
)
def test_a_skin_that_makes_no_sense_is_refused(tmp_path: Path, spoil: tuple[str, str], message: str) -> None:
    with pytest.raises(MeshError, match=message) as caught:
        read(tmp_path, bending_column().replace(*spoil))
    assert str(caught.value).count(str(tmp_path)) == 1


def test_an_animation_that_is_not_well_formed_is_named_once(tmp_path: Path) -> None:
    file = tmp_path / "m.dae"
    file.write_text("<COLLADA>\n<a></COLLADA>")
    with pytest.raises(MeshError) as caught:
        load_motion(file)
    assert str(caught.value).startswith(f"{file}: line 2: not well-formed XML: </COLLADA> does not match <a> ")


@pytest.mark.parametrize("text", ["", "HIERARCHY ROOT a {", "HIERARCHY } MOTION", BVH.replace("90", "x"), BVH[:-30]])
def test_a_motion_that_makes_no_sense_is_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "m.bvh"
    file.write_text(text)
    with pytest.raises(MeshError):
        load_motion(file)


def test_a_skin_with_any_damaged_byte_is_read_or_refused(tmp_path: Path) -> None:
    text = bending_column()
    random = np.random.default_rng(4)
    file = tmp_path / "column.dae"
    read_well = 0
    for position in random.integers(0, len(text), 300).tolist():
        file.write_text(text[:position] + random.choice(list('9-<"e ')) + text[position + 1 :])
        try:
            skin, motion = load_skin(file), load_motion(file)
        except MeshError:
            continue
        read_well += 1
        bones = match_bones(skin.bones, motion.bones) or {}
        with np.errstate(all="ignore"):
            skin.vertices({bones[n]: pose for n, pose in motion.poses(0.7, 1.0).items() if n in bones})
    assert read_well > 50

"""Annotations against the geometry that they are of."""

from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import astuple
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError
from trundle.spatial import matrix_from_quaternion, pose_from_row
from trundle.studies.dataset.dataset_world import picture_maker
from trundle.studies.datasets import AnnotatedPicture, ObjectAnnotation, read_dataset_plan
from trundle.studies.datasets.overlay import box_corners
from trundle.studies.datasets.run_length import decode_mask

BOX = """<sdf version="1.6"><model name="box"><link name="body">
<collision name="c"><geometry><box><size>0.4 0.2 0.3</size></box></geometry></collision>
<visual name="v"><geometry><box><size>0.4 0.2 0.3</size></box></geometry></visual></link></model></sdf>"""
WORLD = """<sdf version="1.6"><world name="w"><model name="floor"><static>1</static><link name="l">
<collision name="c"><geometry><box><size>4 4 0.1</size></box></geometry></collision>
<visual name="v"><geometry><box><size>4 4 0.1</size></box></geometry></visual></link></model></world></sdf>"""
HEAD = """\
world: world.sdf
count: 4
size: [320, 240]
samples: 1
camera: {position: [-3, 0, 1], look_at: [0, 0, 0.2], fov: 1.0}
"""


def pictures(folder: Path, text: str, numbers: range = range(1)) -> list[AnnotatedPicture]:
    """Make pictures of a plan in a folder with a floor and a box."""
    (folder / "world.sdf").write_text(WORLD)
    (folder / "box.sdf").write_text(BOX)
    maker = picture_maker(read_dataset_plan(text, file="plan.yaml", folder=folder))
    return [maker.make(number) for number in numbers]


def project(picture: AnnotatedPicture, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Project points by what is written alone: (N, 2) [px]."""
    camera = picture.annotation.camera
    optical_from_world = pose_from_row(np.array(camera.world_from_camera)).inverse()
    x, y, z = (points @ matrix_from_quaternion(optical_from_world.quaternion).T + optical_from_world.position).T
    return np.stack([camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy], axis=-1)


def only(picture: AnnotatedPicture) -> ObjectAnnotation:
    """Return the only object."""
    (found,) = picture.annotation.objects
    return found


SEVERAL = (
    HEAD
    + """\
objects:
  box:
    model: box.sdf
    count: {uniform: [1, 4]}
    surface: floor
    within: {x: [-1, 1], y: [-1, 1]}
    key_points: {corner: [0.2, 0.1, 0.15], under: [0, 0, -0.15]}
"""
)


def test_annotations_agree_with_the_mask(tmp_path: Path) -> None:
    """A box's corners projected by the written camera bound its mask; its key points lie on it, at its depth."""
    unoccluded_count = 0
    for picture in pictures(tmp_path, SEVERAL, range(8)):
        for annotation in picture.annotation.objects:
            mask = decode_mask(annotation.mask)
            assert np.array_equal(mask, picture.instances == annotation.instance)
            assert mask.sum() == annotation.pixels
            corners = project(picture, box_corners(annotation.box_3d))
            amodal = [*corners.min(axis=0), *corners.max(axis=0)]
            if annotation.truncation == 0:
                assert [*astuple(annotation.amodal_box)] == pytest.approx(amodal, abs=1.0)
            if annotation.occlusion == 0 and annotation.truncation == 0:
                assert [*astuple(annotation.box)] == pytest.approx(amodal, abs=1.0)
                unoccluded_count += 1
            corner, under = annotation.key_points
            assert not under.is_visible
            if corner.pixel is not None:
                assert [*corner.pixel] == pytest.approx(project(picture, np.array([corner.world]))[0].tolist())
            if corner.is_visible:
                assert corner.pixel is not None
                column, row = (int(number) for number in corner.pixel)
                assert mask[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2].any()
    assert unoccluded_count >= 4


def test_models_stand_on_the_surface_apart_from_each_other(tmp_path: Path) -> None:
    for picture in pictures(tmp_path, SEVERAL, range(8)):
        placed = [box_corners(annotation.box_3d) for annotation in picture.annotation.objects]
        for corners in placed:
            assert corners[:, 2].min() == pytest.approx(0.051, abs=1e-6)  # a millimetre above the floor
        for i, one in enumerate(placed):
            assert all(_are_apart(one, other) for other in placed[:i])


def _are_apart(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """True if a vertical plane along a side of one of two upright boxes separates them."""
    for corners in (one, other):
        for side in (corners[4] - corners[0], corners[2] - corners[0]):
            a, b = one @ side, other @ side
            if a.min() >= b.max() - 1e-3 or b.min() >= a.max() - 1e-3:
                return True
    return False


def test_half_an_object_beyond_the_edge_is_half_truncated(tmp_path: Path) -> None:
    """A box whose middle is at the picture's left edge is cut in two."""
    text = (
        HEAD.replace("[0, 0, 0.2]", "[0, 0, 1]")
        + "objects: {box: {model: box.sdf, position: [0, POSITION, 1], rotation: [0, 0, 0]}}"
    )
    left_edge = 3.0 * np.tan(0.5)  # of the picture, at the middle of the box
    (inside,) = pictures(tmp_path, text.replace("POSITION", "0"))
    (cut,) = pictures(tmp_path, text.replace("POSITION", f"{left_edge}"))

    assert only(inside).truncation == 0
    assert only(cut).truncation == pytest.approx(0.5, abs=0.06)  # perspective shows more of the near part
    assert only(cut).occlusion == 0
    assert only(cut).amodal_box.left == 0


def test_an_object_half_behind_another_is_half_occluded(tmp_path: Path) -> None:
    text = HEAD.replace("[0, 0, 0.2]", "[0, 0, 1]") + (
        "objects:\n  box: {model: box.sdf, position: [0, 0, 1], rotation: [0, 0, 1.5708]}\n"
        "  near: {model: box.sdf, position: [-1.5, -0.2, 1], rotation: [0, 0, 1.5708]}\n"
    )
    (picture,) = pictures(tmp_path, text)
    box, near = picture.annotation.objects

    assert near.occlusion == 0
    assert box.occlusion == pytest.approx(0.5, abs=0.03)  # the near one ends at y = 0, where the camera is
    assert box.amodal_box.width == pytest.approx(320 / np.tan(0.5) / 2 * 0.4 / 2.9, abs=1.0)
    assert box.box.width == pytest.approx(0.5 * box.amodal_box.width, abs=1.0)


def test_depth_is_along_the_view_axis_in_metres(tmp_path: Path) -> None:
    text = (
        HEAD.replace("[0, 0, 0.2]", "[0, 0, 1]")
        + "objects: {box: {model: box.sdf, position: [0, 0, 1], rotation: [0, 0, 0]}}"
    )
    (picture,) = pictures(tmp_path, text)
    assert picture.depth[picture.instances == 1].min() == pytest.approx(2.8, abs=1e-3)


def test_a_number_gives_its_picture_again(tmp_path: Path) -> None:
    in_order = pictures(tmp_path, SEVERAL, range(4))
    (alone,) = pictures(tmp_path, SEVERAL, range(3, 4))

    assert alone.annotation == in_order[3].annotation
    assert alone.rgb.tobytes() == in_order[3].rgb.tobytes()
    assert alone.depth.tobytes() == in_order[3].depth.tobytes()


def test_settled_models_rest_on_what_is_below_them(tmp_path: Path) -> None:
    text = HEAD + (
        "settle: 1.5\nobjects: {box: {model: box.sdf, count: 2, position: [{uniform: [-1, 1]}, "
        "{uniform: [-1, 1]}, 0.8], rotation: any}}"
    )
    for picture in pictures(tmp_path, text, range(2)):
        assert len(picture.annotation.objects) == 2
        for annotation in picture.annotation.objects:
            lowest = box_corners(annotation.box_3d)[:, 2].min()
            assert lowest == pytest.approx(0.05, abs=0.01)


def test_key_points_follow_their_link(tmp_path: Path) -> None:
    (tmp_path / "arm.sdf").write_text("""<sdf version="1.6"><model name="arm"><link name="base">
      <visual name="v"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></visual></link>
      <link name="tip"><pose>0 0 0.5 0 0 0</pose>
      <visual name="v"><geometry><sphere><radius>0.05</radius></sphere></geometry></visual></link>
      <joint name="j" type="revolute"><parent>base</parent><child>tip</child><pose>0 0 -0.5 0 0 0</pose>
      <axis><xyz>1 0 0</xyz><limit><lower>-2</lower><upper>2</upper></limit></axis></joint></model></sdf>""")
    text = HEAD + (
        "objects: {arm: {model: arm.sdf, position: [0, 0, 1], rotation: [0, 0, 0], joints: {j: 1.5707963}, "
        "key_points: {tip: {link: tip, at: [0, 0, 0]}}}}"
    )
    (picture,) = pictures(tmp_path, text)
    (point,) = only(picture).key_points

    assert [*point.world] == pytest.approx([0, -0.5, 1], abs=1e-5)
    assert only(picture).world_from_model[:3] == pytest.approx((0.0, 0.0, 1.0))


@pytest.mark.parametrize(
    ("objects", "message"),
    [
        (
            "{box: {model: box.sdf, surface: table}}",
            "plan.yaml:6: error: the world has no model 'table'; models: 'floor'",
        ),
        ("{table: {}}", "plan.yaml:6: error: the world has no model 'table'; models: floor; `model: FILE` adds one"),
        ("{box: {model: bx.sdf, surface: floor}}", "plan.yaml:6: error: bx.sdf: no such file or folder"),
        (
            "{box: {model: box.sdf, surface: floor, joints: {j: 1}}}",
            "plan.yaml:6: error: model 'box_0' has no joint 'j'",
        ),
        (
            "{box: {model: box.sdf, surface: floor, key_points: {a: {link: l, at: [0, 0, 0]}}}}",
            "plan.yaml:6: error: key point 'a': no link 'l'; links: body",
        ),
        (
            "{box: {model: box.sdf, surface: floor}}\nmaterials: {wall: {color: any}}",
            "plan.yaml:7: error: there is no model 'wall' with a visual; models: floor, box_0",
        ),
        (
            "{box: {model: box.sdf, surface: floor}}\nlights: {sun: {}}",
            "plan.yaml:7: error: the world has no light 'sun'",
        ),
    ],
)
def test_a_plan_that_names_what_is_not_there_is_refused(objects: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(DescriptionError) as caught:
        pictures(tmp_path, f"{HEAD}objects: {objects}\n")
    assert str(caught.value).startswith(message)


EYE = """<model name="rover"><pose>-2 0 0.2 0 0 0</pose><static>1</static><link name="head"><pose>0 0 0.5 0 0 0</pose>
<sensor name="eye" type="camera"><pose>0.1 0 0 0 0.2 0</pose><camera><horizontal_fov>0.9</horizontal_fov>
<image><width>200</width><height>120</height></image><clip><near>0.05</near><far>30</far></clip></camera></sensor>
</link></model>"""
OF_THE_ROVER = """\
world: world.sdf
count: 2
camera: rover/eye
objects: {box: {model: box.sdf, position: [0, 0, 0.2]}}
"""


def _rover(folder: Path, text: str = OF_THE_ROVER) -> AnnotatedPicture:
    (folder / "world.sdf").write_text(WORLD.replace("</world>", f"{EYE}</world>"))
    (folder / "box.sdf").write_text(BOX)
    return picture_maker(read_dataset_plan(text, file="plan.yaml", folder=folder)).make(0)


def test_a_robot_s_own_camera_makes_the_pictures(tmp_path: Path) -> None:
    """Its place, image size and field of view are the sensor's, and what is written agrees with the pixels."""
    picture = _rover(tmp_path)

    assert picture.rgb.shape == (120, 200, 3)
    camera = picture.annotation.camera
    assert camera.world_from_camera[:3] == pytest.approx((-1.9, 0, 0.7))
    assert camera.fx == pytest.approx(100 / np.tan(0.45))
    corners = project(picture, box_corners(only(picture).box_3d))
    rows, columns = np.nonzero(picture.instances)
    assert corners[:, 0].min() == pytest.approx(columns.min(), abs=1.5)
    assert corners[:, 0].max() == pytest.approx(columns.max() + 1, abs=1.5)
    assert corners[:, 1].max() == pytest.approx(rows.max() + 1, abs=1.5)


@pytest.mark.parametrize(
    ("changed", "by", "message"),
    [
        ("rover/eye", "rover/ear", "plan.yaml:3: error: there is no camera 'rover/ear'; cameras: rover/eye"),
        ("count: 2", "count: 2\nsize: [64, 48]", "the size of the pictures is that of the camera's sensor"),
    ],
)
def test_a_camera_that_is_not_there_is_refused(tmp_path: Path, changed: str, by: str, message: str) -> None:
    with pytest.raises(DescriptionError, match=message):
        _rover(tmp_path, OF_THE_ROVER.replace(changed, by))


LIGHTS = """<light name="sun" type="directional"><direction>0.6 0 -0.8</direction></light>
<light name="lamp" type="point"><pose>0 0 3 0 0 0</pose></light>"""
LIT = HEAD + "objects: {box: {model: box.sdf, position: [0, 0, 0.5], color: any}}\n"


def _lit(folder: Path, more: str) -> AnnotatedPicture:
    (folder / "world.sdf").write_text(WORLD.replace("</world>", f"{LIGHTS}</world>"))
    (folder / "box.sdf").write_text(BOX)
    return picture_maker(read_dataset_plan(LIT + more, file="plan.yaml", folder=folder)).make(0)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ("lights: {sun: {position: [0, 0, 1]}}", "light sun: a directional light has no `position`; give `azimuth`"),
        ("lights: {lamp: {elevation: 1}}", "light lamp: a point light has no `elevation`; leave it out"),
        ("materials: {box_0: {color: any}}", "materials: object 'box_0' has a look of its own; give one of them"),
    ],
)
def test_settings_that_the_world_would_not_use_are_refused(tmp_path: Path, more: str, message: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        _lit(tmp_path, more)
    assert str(caught.value).startswith(f"plan.yaml:7: error: {message}")


def test_a_light_of_the_world_casts_shadows_as_the_plan_says(tmp_path: Path) -> None:
    written, cast, none = (
        _lit(tmp_path, f"lights: {{sun: {{{shadows}}}}}").rgb for shadows in ("", "shadows: true", "shadows: false")
    )

    assert np.array_equal(written, none)
    assert (cast < written).any()

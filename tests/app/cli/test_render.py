"""`trundle render`: a file becomes a picture."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageSequence
from tests.video_file import read_video

from trundle.app.cli import main

BOX = """<sdf version="1.6"><model name="m"><static>true</static><link name="l">
<visual name="v"><pose>3 1 0.5 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual>
<sensor name="eye" type="camera"><pose>0 0 0.5 0 0 0</pose><camera><horizontal_fov>1.2</horizontal_fov>
<image><width>120</width><height>80</height></image><clip><near>0.1</near><far>20</far></clip></camera></sensor>
</link></model></sdf>"""
FOCAL_PX = 60 / np.tan(0.6)


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A red cube ahead and to the left of a camera; its near face is 2.5 m away."""
    file = tmp_path / "box.sdf"
    file.write_text(BOX)
    return file


def _red(file: Path) -> NDArray[np.bool_]:
    return _is_red(np.asarray(Image.open(file).convert("RGB")))


def _is_red(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    pixels = picture.astype(int)
    return pixels[..., 0] > pixels[..., 1] + 60


def test_the_default_view_centers_the_model(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "all.png"

    assert main(["render", str(model), "-o", str(out), "--size", "200x150"]) == 0

    red = _red(out)
    assert red.shape == (150, 200)
    rows, columns = np.nonzero(red)
    assert rows.min() > 0
    assert rows.max() < 149
    assert columns.min() > 0
    assert columns.max() < 199
    assert abs((rows.min() + rows.max()) / 2 - 74.5) < 15
    assert abs((columns.min() + columns.max()) / 2 - 99.5) < 15
    assert rows.max() - rows.min() > 75


def test_a_camera_of_the_file_renders_its_view_in_its_size(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "eye.png"

    assert main(["render", str(model), "-o", str(out), "--camera", "eye"]) == 0

    red = _red(out)
    assert red.shape == (80, 120)
    columns = np.nonzero(red.any(axis=0))[0]
    # y from 0.5 to 1.5 m: the left edge belongs to the near face, the right edge to the far face at 3.5 m.
    assert columns.min() == pytest.approx(60 - FOCAL_PX * 1.5 / 2.5, abs=1.5)
    assert columns.max() == pytest.approx(60 - FOCAL_PX * 0.5 / 3.5, abs=1.5)


def test_depth_is_in_millimetres_along_the_view_and_zero_without_a_hit(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "depth.png"

    assert main(["render", str(model), "-o", str(out), "--camera", "eye", "--depth"]) == 0

    depth = np.asarray(Image.open(out))
    assert depth.dtype == np.uint16
    row, column = 40, int(60 - FOCAL_PX / 2.5)
    assert depth[row, column] == pytest.approx(2500, abs=1)
    assert depth[0, 119] == 0


def test_rendering_a_file_twice_gives_equal_pictures(model: Path, tmp_path: Path) -> None:
    paths = [tmp_path / "one.png", tmp_path / "two.png"]

    for out in paths:
        assert main(["render", str(model), "-o", str(out), "--size", "90x60"]) == 0

    assert paths[0].read_bytes() == paths[1].read_bytes()


def _with_lens(model: Path, type_: str, inside: str) -> None:
    text = BOX.replace('type="camera"', f'type="{type_}"').replace("</camera>", f"{inside}</camera>")
    assert text != BOX
    model.write_text(text)


def test_a_fisheye_camera_renders_through_its_lens(model: Path, tmp_path: Path) -> None:
    """A field of view of three radians shows the whole box small; the corners stay black."""
    lens = "<lens><type>equidistant</type><cutoff_angle>1.5</cutoff_angle></lens>"
    _with_lens(model, "wideanglecamera", lens)
    model.write_text(model.read_text().replace(">1.2<", ">3<"))
    out = tmp_path / "round.png"

    assert main(["render", str(model), "-o", str(out), "--camera", "eye"]) == 0

    picture = np.asarray(Image.open(out).convert("RGB"))
    assert picture.shape == (80, 120, 3)
    assert (picture[0, 0] == 0).all()
    assert (picture[40, 60] > 0).any()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--size", "60x40"], "camera 'eye' has a lens; the size of its picture is fixed, 120x80"),
        (["--depth"], "camera 'eye' is a wide-angle camera; depth needs a pinhole camera"),
    ],
)
def test_options_that_a_lens_excludes_are_errors(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    _with_lens(model, "wideanglecamera", "")

    assert main(["render", str(model), "-o", str(tmp_path / "no.png"), "--camera", "eye", *options]) != 0
    assert message in capsys.readouterr().err


def test_depth_is_not_distorted(model: Path, tmp_path: Path) -> None:
    model.write_text(BOX.replace("</camera>", "<distortion><k1>-0.2</k1></distortion></camera>"))
    out = tmp_path / "depth.png"

    assert main(["render", str(model), "-o", str(out), "--camera", "eye", "--depth"]) == 0

    depth = np.asarray(Image.open(out))
    assert depth[40, int(60 - FOCAL_PX / 2.5)] == pytest.approx(2500, abs=1)


def test_the_error_of_an_unknown_camera_lists_the_cameras(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "no.png"

    assert main(["render", str(model), "-o", str(out), "--camera", "nose"]) != 0

    assert "no camera 'nose'; cameras there: 'eye'" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize("name", ["folder/that/is/not/there.png", "picture.xyz"])
def test_an_unwritable_path_is_an_error_of_one_sentence(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    assert main(["render", str(model), "-o", str(tmp_path / name), "--size", "20x20"]) != 0

    text = capsys.readouterr().err
    assert f"cannot write {tmp_path / name}" in text
    assert "Traceback" not in text
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize("size", ["800", "0x600", "-1x5", "axb", "99999x1", "1e3x2"])
def test_an_invalid_size_is_wrong_usage(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], size: str
) -> None:
    try:
        code = main(["render", str(model), "-o", str(tmp_path / "a.png"), f"--size={size}"])
    except SystemExit as end:
        code = end.code

    assert code == 2
    assert "is not a size; give WIDTHxHEIGHT" in capsys.readouterr().err


@pytest.mark.parametrize("source", ["command line", "file"])
def test_a_picture_too_large_for_memory_is_refused(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], source: str
) -> None:
    arguments = ["render", str(model), "-o", str(tmp_path / "huge.png"), "--camera", "eye"]
    if source == "file":
        model.write_text(BOX.replace(">120<", ">5000<").replace(">80<", ">5000<"))
    else:
        arguments += ["--size", "5000x5000"]

    assert main(arguments) != 0

    assert "a picture of 5000x5000 is too large" in capsys.readouterr().err


def test_segmentation_has_one_color_for_each_visual(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "seg.png"

    assert main(["render", str(model), "-o", str(out), "--camera", "eye", "--seg"]) == 0

    colors = {tuple(pixel) for row in np.asarray(Image.open(out)) for pixel in row.tolist()}
    assert len(colors) == 3  # nothing, the ground, the cube
    assert (0, 0, 0) in colors


FALLING = BOX.replace("<static>true</static>", "").replace("<visual", "<inertial><mass>1</mass></inertial><visual", 1)


def test_a_picture_is_rendered_at_the_requested_time(model: Path, tmp_path: Path) -> None:
    """A link with its camera falls 1.225 m in half a second; only the ground is in view."""
    model.write_text(
        FALLING.replace("<far>20<", "<far>50<").replace(
            '<sensor name="eye"', '<pose>0 0 9 0 0 0</pose><sensor name="eye"'
        )
    )
    for name, time_s in (("start", "0"), ("later", "0.5")):
        command = [
            "render",
            str(model),
            "-o",
            str(tmp_path / f"{name}.png"),
            "--camera",
            "eye",
            "--depth",
            "--at",
            time_s,
        ]
        assert main(command) == 0
    depths = [np.asarray(Image.open(tmp_path / f"{name}.png")) for name in ("start", "later")]
    bottom_row = depths[0].shape[0] - 1
    # Distance to the ground over height, in a row atan((79.5 - 40) / f) below the horizon.
    ratio = FOCAL_PX / (bottom_row + 0.5 - 40)
    for depth, height in zip(depths, (9.5, 9.5 - 9.8 / 2 * 0.25), strict=True):
        assert depth[bottom_row, 110] == pytest.approx(1000 * height * ratio, rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["mp4", "webp", "gif"])
def test_a_video_orbits_the_model_or_shows_a_run(model: Path, tmp_path: Path, suffix: str) -> None:
    around, run = tmp_path / f"around.{suffix}", tmp_path / f"run.{suffix}"

    assert main(["render", str(model), "-o", str(around), "--orbit", "--size", "64x48"]) == 0
    model.write_text(FALLING)
    assert main(["render", str(model), "-o", str(run), "--duration", "0.4", "--size", "64x48"]) == 0

    frames = _frames(around)
    assert len(frames) == 200
    assert frames[0].shape == (48, 64, 3)
    assert np.abs(frames[0].astype(int) - frames[100]).max() > 50
    assert len(_frames(run)) == 10


DROP = """<sdf version="1.6"><world name="w">
<model name="plate"><pose>4 0 1.5 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>0.01 0.4 0.4</size></box></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link></model>
<model name="post"><static>1</static><link name="l"><sensor name="eye" type="camera"><pose>0 0 0.5 0 0 0</pose>
<camera><horizontal_fov>1.2</horizontal_fov><image><width>120</width><height>80</height></image>
<clip><near>0.1</near><far>20</far></clip></camera></sensor></link></model></world></sdf>"""


@pytest.mark.slow
def test_a_video_of_a_camera_has_simulated_time(tmp_path: Path) -> None:
    """A body falling 4 m in front of a camera of focal length f moves down f g t² / (2 · 4 m) pixels in t."""
    world, out = tmp_path / "drop.world", tmp_path / "eye.mp4"
    world.write_text(DROP)

    assert main(["render", str(world), "-o", str(out), "--camera", "eye", "--duration", "0.4"]) == 0

    frames = read_video(out)
    rows = [np.nonzero(_is_red(frame.picture))[0].mean() for frame in frames]
    assert len(frames) == 10
    assert frames[0].picture.shape == (80, 120, 3)
    squares = [frame.time_s**2 for frame in frames]
    assert np.polyfit(squares, rows, 1)[0] == pytest.approx(FOCAL_PX * 9.8 / 8, rel=0.05)


def _frames(video: Path) -> list[NDArray[np.uint8]]:
    if video.suffix == ".mp4":
        return [frame.picture for frame in read_video(video)]
    with Image.open(video) as image:
        return [np.asarray(frame.convert("RGB")) for frame in ImageSequence.all_frames(image)]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["-o", "a.png", "--orbit"], "a video's file ends in .mp4, .webp, .gif, .apng, not in '.png'"),
        (["-o", "a.png", "--duration", "2"], "a video's file ends in"),
        (["-o", "a.mp4", "--depth"], "depth needs 16 bits"),
        (["-o", "a.mp4", "--orbit", "--camera", "eye"], "it excludes --camera and --duration"),
    ],
)
def test_invalid_video_options_are_errors(
    model: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    assert main(["render", str(model), *words]) != 0
    assert message in capsys.readouterr().err


@pytest.mark.slow
def test_opengl_renders_the_same_picture(model: Path, tmp_path: Path) -> None:
    """Without OpenGL the command fails; no other renderer replaces it."""
    cpu, egl = tmp_path / "cpu.png", tmp_path / "egl.png"
    command = ["render", str(model), "--camera", "eye"]
    assert main([*command, "-o", str(cpu)]) == 0
    if main([*command, "-o", str(egl), "--renderer", "egl"]) != 0:
        assert not egl.exists()
        pytest.skip("no OpenGL over EGL here")
    assert (_red(cpu) != _red(egl)).mean() < 0.01


RED_AND_BLUE = """<sdf version="1.6"><world name="w"><include><uri>model://sun</uri></include>
<include><uri>model://{}</uri></include>
<model name="red"><static>1</static><pose>-1 4 0.5 0 0 0</pose><link name="l"><visual name="v"><geometry><box>
<size>1 1 1</size></box></geometry><material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual>
</link></model>
<model name="blue"><static>1</static><pose>1.5 4 0.75 0 0 0</pose><link name="l"><visual name="v"><geometry><cylinder>
<radius>0.3</radius><length>1.5</length></cylinder></geometry><material><ambient>0 0 1 1</ambient><diffuse>0 0 1 1
</diffuse></material></visual></link></model></world></sdf>"""


@pytest.mark.parametrize("camera", ["my_sensor", "netbook_webcam"])
def test_both_cameras_of_rp2w_camsave_see_the_models_ahead(tmp_path: Path, camera: str) -> None:
    """The columns were measured in Gazebo's picture of this scene, 320 pixels wide."""
    world, out = tmp_path / "scene.world", tmp_path / "a.png"
    world.write_text(RED_AND_BLUE.format("rp2w_camsave"))

    assert main(["render", str(world), "--camera", camera, "-o", str(out)]) == 0

    pixels = np.asarray(Image.open(out)).astype(int)
    assert pixels.shape == (240, 320, 3)
    red, blue = (np.nonzero((pixels[..., i] > pixels[..., 2 - i] + 60).any(axis=0))[0] for i in (0, 2))
    assert (red.min(), red.max()) == pytest.approx((38, 128), abs=2)
    assert (blue.min(), blue.max()) == pytest.approx((244, 289), abs=2)


def test_the_error_of_an_unknown_camera_follows_the_warnings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The missing model may be the model with the camera."""
    world = tmp_path / "scene.world"
    world.write_text(RED_AND_BLUE.format("lost"))

    assert main(["render", str(world), "--camera", "eye", "-o", str(tmp_path / "a.png")]) == 1

    errors = capsys.readouterr().err
    assert f"{world}:2: warning: model://lost: no model 'lost'" in errors
    assert "no camera 'eye'; cameras there: none" in errors


def test_an_empty_picture_is_explained_in_the_last_line(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "ghost.urdf"
    mesh = '<visual><geometry><mesh filename="package://ghost_description/body.dae"/></geometry></visual>'
    inertial = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    file.write_text(f'<robot name="ghost"><link name="base">{inertial}{mesh}</link></robot>')

    assert main(["render", str(file), "-o", str(tmp_path / "ghost.png"), "--size", "40x30"]) == 0

    lines = capfd.readouterr().err.splitlines()
    assert "no package 'ghost_description'" in lines[0]
    assert lines[-1] == (
        f"{file}: nothing is visible: none of its meshes was found (package://ghost_description/body.dae)"
    )


def test_a_robot_without_masses_is_drawn_as_in_the_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """URDFs of first tutorials have no masses; Gazebo cannot simulate them. The arm is below its joint."""
    robot, out = tmp_path / "r.urdf", tmp_path / "r.png"
    robot.write_text(
        """<robot name="r"><material name="m"><color rgba="1 0 0 1"/></material>
        <link name="base"><visual><geometry><box size="0.4 0.4 0.4"/></geometry><material name="m"/></visual></link>
        <link name="arm"><visual><geometry><cylinder radius="0.1" length="1"/></geometry><material name="m"/></visual>
        </link><joint name="j" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 -0.7"/>
        <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
    )

    assert main(["render", str(robot), "-o", str(out), "--size", "200x150"]) == 0

    rows, columns = np.nonzero(_red(out))
    assert rows.min() > 0
    assert rows.max() < 149
    assert rows.max() - rows.min() > 2 * (columns.max() - columns.min())
    assert f"{robot}: it cannot be simulated; it is drawn as in the file" in capsys.readouterr().err


def test_the_ground_does_not_hide_a_robot_below_it(tmp_path: Path) -> None:
    """Many robots have their root in the middle; in a simulation the ground pushes them up."""
    model, out = tmp_path / "m.sdf", tmp_path / "m.png"
    model.write_text(BOX.replace("<pose>3 1 0.5 0 0 0</pose>", "<pose>3 1 -4 0 0 0</pose>"))

    assert main(["render", str(model), "-o", str(out), "--size", "200x150"]) == 0

    assert _red(out).sum() > 1000

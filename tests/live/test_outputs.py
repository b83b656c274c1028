"""Pictures, films, recordings and plots that a program makes of a simulation."""

import csv
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import trundle
from trundle.ros import open_bag


def _falling() -> trundle.LoadedSimulation:
    """A red ball, 1 m above the ground."""
    world = trundle.World("w", gravity=(0, 0, -9.8))
    world.add_light()
    world.add_ground_plane()
    world.add_sphere("ball", 0.2, pose=(0, 0, 1.2), color=(1, 0, 0))
    return trundle.load(world)


def test_a_free_camera_sees_where_it_looks() -> None:
    sim = _falling()

    image = sim.picture((3, 0, 1.2), (0, 0, 1.2), size=(160, 120))
    away = sim.picture((3, 0, 1.2), (6, 0, 1.2), size=(160, 120))
    whole = sim.picture(size=(80, 60))

    assert image.rgb.shape == (120, 160, 3)
    assert image.names[image.segmentation[60, 80]] == "ball::link::ball"
    red, green, _ = image.rgb[60, 80].tolist()
    assert red > 2 * green
    assert image.depth is not None
    assert image.depth[60, 80] == pytest.approx(2.8, abs=0.01)
    assert not away.mask("ball").any()
    assert whole.mask("ball").any()


def test_a_free_camera_follows_models_that_come_and_go() -> None:
    sim = _falling()
    sim.picture((3, 0, 1.2), (0, 0, 1.2), size=(40, 30))

    sim.delete("ball")

    assert "ball::link::ball" not in sim.picture((3, 0, 1.2), (0, 0, 1.2), size=(40, 30)).names


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"eye": (1, 2)}, r"^eye \[m\] must be 3 finite numbers"),
        ({"eye": (1, 2, 3), "target": (1, 2, 3)}, "^eye and target are the same point"),
        ({"size": (0, 10)}, "^a picture of 0 x 10 px is not possible"),
        ({"size": 3}, r"^size must be \(width, height\)"),
        ({"fov_rad": 4.0}, r"^fov_rad must be between 0 and π \[rad\], got 4.0"),
    ],
)
def test_pictures_that_cannot_be_drawn_are_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(trundle.UsageError, match=message):
        _falling().picture(**arguments)  # pyright: ignore[reportArgumentType]


def test_a_film_has_25_frames_for_each_simulated_second(tmp_path: Path) -> None:
    sim = _falling()

    with sim.film(tmp_path / "fall.apng", eye=(3, 0, 0.6), target=(0, 0, 0.6), size=(80, 60)) as film:
        sim.run(0.4)
    sim.run(0.4)

    with Image.open(tmp_path / "fall.apng") as video:
        frames = []
        for i in range(getattr(video, "n_frames", 1)):
            video.seek(i)
            frames.append(np.asarray(video.convert("RGB")).astype(int))
    rows = [np.argwhere(frame[:, :, 0] > 2 * frame[:, :, 1] + 20)[:, 0].mean() for frame in frames]
    assert film.frame_count == len(frames) == 11
    assert rows == sorted(rows)
    assert rows[-1] > rows[0] + 10  # it fell


def test_a_film_that_cannot_be_written_says_so(tmp_path: Path) -> None:
    sim = _falling()
    with pytest.raises(
        trundle.UsageError, match=r"^a video's file ends in \.mp4, \.webp, \.gif, \.apng, not in '\.avi'"
    ):
        sim.film(tmp_path / "fall.avi")
    film = sim.film(tmp_path / "none/fall.webp", size=(8, 6))
    sim.run(1.0)
    with pytest.raises(trundle.UsageError, match=r"^cannot write .*fall\.webp"):
        film.close()


def test_a_state_log_has_the_states_of_the_run(tmp_path: Path) -> None:
    sim = _falling()

    with sim.record(tmp_path / "fall.log"):
        sim.run(0.4)
    sim.run(0.4)

    log = trundle.read_state_log(tmp_path / "fall.log")
    height = log.poses[:, log.links.index("ball::link"), 2]
    assert log.times_s[-1] == pytest.approx(0.4)
    assert height == pytest.approx(1.2 - 4.9 * log.times_s**2, abs=0.01)


def test_a_state_log_ends_when_models_change(tmp_path: Path) -> None:
    sim = _falling()
    recording = sim.record(tmp_path / "fall.log")
    sim.run(0.1)
    sim.delete("ball")
    sim.run(0.1)

    with pytest.raises(
        trundle.UsageError, match=r"^the recording ended early: models were spawned, deleted or renamed"
    ):
        recording.close()
    assert len(trundle.read_state_log(tmp_path / "fall.log").times_s) == 6


@pytest.mark.parametrize("suffix", [".bag", ".mcap"])
def test_a_bag_has_the_messages_of_the_run(tmp_path: Path, suffix: str) -> None:
    """It is begun and ended in the middle of a run."""
    file = tmp_path / f"run{suffix}"
    world = trundle.World("w")
    world.add_sphere("ball", 0.2)
    with trundle.load(world, ros=True) as sim:
        numbers = sim.make_node("/counter").advertise("/number", "std_msgs/Float64")
        for number in range(4):
            with sim.record(file) if number == 1 else sim.record(tmp_path / "other.log"):
                numbers.publish({"data": number})
                sim.run(0.1)

    with open_bag(file) as bag:
        messages = [(message.connection.topic, message.stamp_ns) for message in bag.messages()]
    stamps = [stamp for topic, stamp in messages if topic == "/clock"]
    assert [topic for topic, _ in messages].count("/number") == 1
    assert 100_000_000 < min(stamps) <= max(stamps) == 200_000_000


def test_recordings_that_cannot_be_made_are_refused(tmp_path: Path) -> None:
    sim = _falling()
    with pytest.raises(trundle.UsageError, match=r"^a recording's file ends in \.log, \.bag or \.mcap, not in '\.txt'"):
        sim.record(tmp_path / "run.txt")
    with pytest.raises(trundle.UsageError, match="load it with ros=True"):
        sim.record(tmp_path / "run.bag")
    with pytest.raises(trundle.UsageError, match="cannot be written"):
        sim.record(tmp_path / "none/run.log")


def test_a_plot_samples_values_by_the_names_of_the_page(tmp_path: Path) -> None:
    sim = _falling()

    plot = sim.plot("ball.pose.z", "ball::link.twist.linear.z", period_s=0.1)
    sim.run(0.4)
    plot.close()
    sim.run(0.4)

    assert plot.units == ("m", "m/s")
    assert plot.times_s == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.4])
    assert plot["ball::link.twist.linear.z"] == pytest.approx(-9.8 * plot.times_s, abs=0.02)
    assert "ball.pose.z [m]" in str(plot)
    plot.save(tmp_path / "fall.svg")
    plot.save(tmp_path / "fall.csv")
    assert (tmp_path / "fall.svg").read_text() == plot._repr_svg_()
    assert "ball.pose.z [m]" in plot._repr_svg_()
    header, *rows = csv.reader((tmp_path / "fall.csv").read_text().splitlines())
    assert header == ["time", "ball.pose.z", "ball::link.twist.linear.z"]
    assert [float(row[1]) for row in rows] == plot["ball.pose.z"].tolist()


def test_unknown_values_are_refused_with_the_known_ones(tmp_path: Path) -> None:
    sim = _falling()
    with pytest.raises(trundle.UsageError, match=r"^no value ball\.pose\.w; there are: pose.x, pose.y"):
        sim.plot("ball.pose.w")
    with pytest.raises(trundle.UsageError, match=r"^plot needs names of values"):
        sim.plot()
    plot = sim.plot("ball.pose.z")
    with pytest.raises(trundle.UsageError, match=r"there are: 'ball\.pose\.z'"):
        _ = plot["ball.pose.x"]
    with pytest.raises(trundle.UsageError, match=r"ends in \.svg or \.csv, not in '\.pdf'"):
        plot.save(tmp_path / "fall.pdf")

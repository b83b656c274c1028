"""Ranges of sonars."""

from pathlib import Path

import pytest

import trundle
from trundle.sim.sensors import SonarSensor, mount_sensors

_BOX = "<collision name='c'><geometry><box><size>{0} {0} {0}</size></box></geometry></collision>"


def range_of(folder: Path, *, wall: float, offset: float = 0.0, arm: str = "", model: str = "") -> float:
    """Range of a sonar at the origin along +x [m].

    Args:
        folder: takes the file.
        wall: distance of a wall of 1 m [m].
        offset: its offset from the axis [m].
        arm: element that joins a link 1 m ahead to the sonar's model, if any.
        model: further elements of the model.
    """
    file = folder / "w.sdf"
    ahead = f"<link name='arm'><pose>1.25 0 0 0 0 0</pose>{_BOX.format(0.5)}</link>{arm}" if arm else ""
    file.write_text(
        f"""<sdf version="1.6"><world name="w"><model name="m"><static>1</static>{model}
        <link name="l">{_BOX.format(0.2)}<sensor name="s" type="sonar"><pose>0 0 0 0 -1.5707963267948966 0</pose>
        <sonar><min>0.3</min><max>5</max><radius>2</radius></sonar></sensor></link>{ahead}</model>
        <model name="wall"><static>1</static><pose>{wall + 0.5} {offset} 0 0 0 0</pose><link name="l">{_BOX.format(1)}
        </link></model></world></sdf>"""
    )
    sim = trundle.load(str(file))
    (sonar,) = mount_sensors(sim)
    assert isinstance(sonar, SonarSensor)
    return sonar.measure(sim.snapshot()).range_m


def test_a_sonar_reads_the_nearest_point_in_its_cone(tmp_path: Path) -> None:
    assert range_of(tmp_path, wall=2.0) == pytest.approx(2.0, abs=1e-5)
    assert range_of(tmp_path, wall=2.0, offset=1.0) == pytest.approx((4.0 + 0.5**2) ** 0.5, abs=0.03)


@pytest.mark.parametrize(("wall", "offset"), [(6.0, 0.0), (2.0, 3.0)])
def test_a_sonar_reads_its_maximum_without_an_echo(tmp_path: Path, wall: float, offset: float) -> None:
    """No echo reads as the maximum range, as in Gazebo."""
    assert range_of(tmp_path, wall=wall, offset=offset) == 5.0


def test_a_sonar_reads_at_least_its_minimum(tmp_path: Path) -> None:
    assert range_of(tmp_path, wall=0.15) == pytest.approx(0.3)


_FIXED = "<joint name='j' type='fixed'><parent>l</parent><child>arm</child></joint>"
_COLLIDES = "<self_collide>1</self_collide>"


@pytest.mark.parametrize(
    ("arm", "model", "expected"), [(" ", "", 2.0), (" ", _COLLIDES, 1.0), (_FIXED, _COLLIDES, 2.0), (_FIXED, "", 2.0)]
)
def test_a_sonar_hits_its_own_model_only_with_self_collide(
    tmp_path: Path, arm: str, model: str, expected: float
) -> None:
    """Gazebo's sonar is a shape of its link and collides as that link does: not across a joint."""
    assert range_of(tmp_path, wall=2.0, arm=arm, model=model) == pytest.approx(expected, abs=1e-5)

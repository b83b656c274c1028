"""The reference of sensors' settings has an element and a meaning for each, and its program runs."""

import re
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from tests.docs_blocks import ROOT

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.description.builder.sensors import SETTINGS
from trundle.robots.packages import Packages

if not (ROOT / "docs/generate").is_dir():
    pytest.skip("the documentation is not part of the sdist", allow_module_level=True)
sys.path.insert(0, str(ROOT / "docs"))

from generate import sensor_settings

_ROWS = list(sensor_settings.settings())


def test_every_setting_has_an_element_and_a_meaning() -> None:
    assert len(_ROWS) > 90
    assert [(struct.__name__, field) for struct, field, element, meaning in _ROWS if not element or not meaning] == []


def test_a_camera_has_its_elements_and_defaults() -> None:
    page = sensor_settings.page()
    row = next(line for line in page.splitlines() if "<code>depth_far_m</code>" in line)

    assert re.findall(r"<code>([^<]+)</code>", row) == [
        "depth_far_m",
        "float",
        "None",
        "None",
        "camera/depth_camera/clip/far",
    ]
    assert "<code>1.047</code>" in page


def test_structs_of_settings_are_public() -> None:
    assert [struct.__name__ for struct, *_ in _ROWS if getattr(trundle, struct.__name__, None) is not struct] == []


@pytest.mark.parametrize("type_", sorted(set(SETTINGS) - {"force_torque"}))
def test_settings_in_a_file_are_read_as_they_were_written(type_: str, tmp_path: Path) -> None:
    """All numbers of a sensor at once; a number that was not read would be its default."""
    made: Any = sensor_settings.with_other_numbers(SETTINGS[type_])
    model = trundle.Model("m")
    model.add_link("l").add_sensor("s", type_, made)
    model.save(tmp_path / "m.sdf")

    sensor = (
        load(str(tmp_path / "m.sdf"), Diagnostics(), packages=Packages({}, start=tmp_path))
        .world.models[0]
        .links[0]
        .sensors[0]
    )

    # A camera of a multicamera gets a name, a wide-angle one a lens.
    cameras = [msgspec.structs.replace(camera, name="", lens=None) for camera in sensor.cameras]
    parts = [*cameras, sensor.scan, sensor.imu, sensor.gps, sensor.instrument]
    assert [part for part in parts if part is not None] == [made]


def test_the_program_of_the_page_runs() -> None:
    program = re.findall(r"```python\n(.*?)```", sensor_settings.page(), re.DOTALL)[0]
    names: dict[str, Any] = {}

    exec(program, names)

    model = names["world"].to_sdf()
    assert "<samples>360</samples>" in model
    assert "<stddev>0.02</stddev>" in model


def test_numbers_are_all_others() -> None:
    """What the round trip above relies on."""
    for settings in set(SETTINGS.values()):
        made: Any = sensor_settings.with_other_numbers(settings)
        start: Any = settings()
        fields = msgspec.structs.fields(settings)
        numbers = [field.name for field in fields if isinstance(getattr(start, field.name), float | int)]
        assert [name for name in numbers if getattr(made, name) == getattr(start, name)] == []

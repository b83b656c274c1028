"""`trundle check` reports missing plugins with the messages of a run."""

from pathlib import Path

import pytest

from trundle.app.cli.main import main
from trundle.gazebo.check.check_file import check

WORLD = """<sdf version="1.6"><world name="w">
<plugin name="weather" filename="libweather.so"/>
<model name="m"><link name="a">
<visual name="v"><geometry><sphere><radius>1</radius></sphere></geometry>
<plugin name="paint" filename="libpaint.so"/></visual>
<sensor name="s" type="imu"><plugin name="sense" filename="libsense.so"/></sensor>
</link>
<plugin name="arm" filename="libarm.so"/>
<plugin name="laser" filename="libgazebo_ros_laser.so"/>
</model></world></sdf>"""


def test_missing_plugins_are_reported_with_lines_and_in_a_runs_words(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "w.world"
    file.write_text(WORLD)

    warnings = check(str(file), {}, start=tmp_path).report.warnings

    def missing(line: int, name: str) -> str:
        where = f"looked for {name}.py in {tmp_path}; the run goes on without it"
        return (
            f"{file}:{line}: warning: plugin {name!r}: no lib{name}.so; Trundle runs C++ of its kit and Python: {where}"
        )

    assert warnings == [
        missing(2, "weather"),
        missing(8, "arm"),
        f"{file}:9: warning: plugin 'laser' (libgazebo_ros_laser.so) is a sensor's; it belongs into a <sensor>; "
        "the run goes on without it",
        missing(5, "paint"),
        f"{file}:6: warning: sensor 's': plugin libsense.so is not supported yet; the sensor has topics without",
    ]
    assert main(["run", str(file), "--headless", "--no-ros", "--speed", "max", "--duration", "0.01"]) == 0
    stderr = capsys.readouterr().err
    assert all(warning in stderr for warning in warnings[:-1])  # the last is one of topics, and there are none


def test_a_python_plugin_is_found_but_not_executed(tmp_path: Path) -> None:
    (tmp_path / "model").mkdir()
    file = tmp_path / "model" / "model.sdf"
    file.write_text(
        '<sdf version="1.6"><model name="m"><link name="a"/><plugin name="p" filename="libarm.so"/>'
        '<plugin name="q" filename="libgazebo_ros_diff_drive.so"/></model></sdf>'
    )
    (tmp_path / "arm.py").write_text("raise SystemExit('run by a check')")

    assert check(str(file), {"TRUNDLE_PLUGIN_PATH": str(tmp_path)}, start=tmp_path).report.warnings == []

"""`trundle check` and `trundle xacro` on the published robots."""

import json
import subprocess
import sys

import pytest


def test_check_reads_the_published_rp2w_and_reports_its_peculiarities(trundle, shared) -> None:
    done = trundle("check", str(shared / "seeds/rp2w/model.sdf"), "--json")

    assert done.returncode == 0
    result = json.loads(done.stdout)
    (model,) = result["models"]
    assert (result["kind"], result["sdf_version"], model["canonical_link"]) == ("model", "1.4", "chassis")
    assert [len(model[part]) for part in ("links", "joints", "plugins")] == [7, 6, 1]
    wheel = next(joint for joint in model["joints"] if joint["name"] == "chassis_left_wheel")
    assert wheel["axis"] == [1.0, 0.0, 0.0]
    assert (wheel["lower"], wheel["upper"], wheel["friction"]) == (None, None, 0.3)
    assert model["links"][0]["inertia"] == [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
    messages = " ".join(finding["message"] for finding in result["diagnostics"])
    oddities = ("z of zero thickness", "SDF's default of 1 kg·m²", "leaves no freedom", "read in the model frame")
    for oddity in (*oddities, "rolls on the ellipsoid inscribed in it, a surface up to 0.1 mm away"):
        assert oddity in messages


def test_a_plain_robot_imports_no_heavy_modules(shared) -> None:
    """The slowest imports are the engine, NumPy, YAML, and dataclasses of unused sensors."""
    file = shared / "seeds/smartcar_description/urdf/smartcar.urdf.xacro"
    code = "import sys; from trundle.app.cli import main; main(['check', sys.argv[1]]); print(*sorted(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code, str(file)], capture_output=True, text=True, check=True)

    loaded = set(done.stdout.splitlines()[-1].split())
    unwanted = {
        "mujoco",
        "numpy",
        "yaml",
        "json",
        "socket",
        "trundle.robots.model.sensor",
        "trundle.robots.description.sdf.world",
    }
    assert "lxml.etree" in loaded
    assert not unwanted & loaded


def test_a_warning_fails_with_strict(trundle, shared) -> None:
    assert trundle("check", str(shared / "seeds/rp2w"), "--strict").returncode == 1


def test_check_reports_the_trees_of_a_urdf_and_its_sdf(trundle, shared) -> None:
    file = shared / "seeds/smartcar_description/urdf/smartcar.urdf.xacro"
    result = json.loads(trundle("check", str(file), "--json").stdout)

    assert result["urdf"]["links"][0]["name"] == result["urdf"]["root"] == "base_link"
    assert (len(result["urdf"]["links"]), len(result["models"][0]["links"])) == (6, 5)


def test_commands_of_a_launch_file_are_not_run(trundle, shared) -> None:
    file = shared / "seeds/smartcar_description/launch/smartcar_display.rviz.launch"
    result = json.loads(trundle("check", str(file), "--json").stdout)

    assert result["kind"] == "launch"
    assert len(result["nodes"]) == 6
    assert "smartcar.urdf.xacro" in result["params"]["/robot_description"]["command"]


@pytest.mark.parametrize(
    ("words", "code", "message"), [((), 0, 'link name="base_link"'), (("oops",), 1, "give NAME:=VALUE")]
)
def test_xacro_expands_a_file(trundle, shared, words, code, message) -> None:
    done = trundle("xacro", str(shared / "seeds/smartcar_description/urdf/smartcar.urdf.xacro"), *words)

    assert done.returncode == code
    assert message in done.stdout + done.stderr

"""Headers of configurations, as text."""

import os
from pathlib import Path

from trundle.ros.rospy.environment import with_finder
from trundle.ros.sdk import write_config_headers

_SOURCE = Path(__file__).parents[2] / "data/sdk/src/cpp_config"


def test_a_configuration_has_its_members_groups_and_constants(tmp_path: Path) -> None:
    assert write_config_headers("cpp_config", _SOURCE, tmp_path, with_finder(os.environ)) == []

    text = (tmp_path / "cpp_config/DriveConfig.h").read_text()
    assert "namespace cpp_config {" in text
    assert "  int mode = 0;\n  double gain = 0.5;\n" in text
    assert '  std::string frame = "base \\\\ \\077\\077/";\n' in text, "no trigraph"
    assert "      } inner;\n      bool state = false;\n" in text
    assert "const int Drive_Fast = 3;" in text
    assert "c.turns = -2147483647 - 1;" in text
    assert "c.speed = __builtin_inf();" in text


def test_an_invalid_file_is_named_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text("generate_dynamic_reconfigure_options(Bad.cfg None.cfg)\n# x(No.cfg)\n")
    (tmp_path / "Bad.cfg").write_text("from dynamic_reconfigure.parameter_generator_catkin import *\n\n1 / 0\n")

    bad, none = write_config_headers("demo", tmp_path, tmp_path / "include", with_finder(os.environ))

    assert bad == f"{tmp_path}/Bad.cfg:3: error: ZeroDivisionError: division by zero"
    assert none == f"{tmp_path}/CMakeLists.txt: error: {tmp_path}/None.cfg is missing"
    assert not (tmp_path / "include").exists()


def test_the_namespace_is_the_package_that_the_file_names(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text("generate_dynamic_reconfigure_options(Drive.cfg)\n")
    (tmp_path / "Drive.cfg").write_text(
        "from dynamic_reconfigure.parameter_generator_catkin import *\n"
        'gen = ParameterGenerator()\ngen.generate("drive_settings", "drive", "Drive")\n'
    )
    assert write_config_headers("drive", tmp_path, tmp_path / "include", with_finder(os.environ)) == []
    assert "namespace drive_settings {" in (tmp_path / "include/drive/DriveConfig.h").read_text()

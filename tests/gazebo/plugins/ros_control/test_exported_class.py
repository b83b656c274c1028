"""Classes that packages export for ros_control, and the libraries that the development kit has compiled."""

from pathlib import Path

import pytest

from trundle.gazebo.plugins.ros_control.exported_class import exported_classes, library_of
from trundle.robots.parameters import ParamError

_MANIFEST = """<package><name>sway</name><export>
<controller_interface plugin="${prefix}/plugins.xml"/></export></package>"""
_PLUGINS = """<class_libraries><library path="lib/libsway">
<class name="sway/Sway" type="sway::Sway" base_class_type="controller_interface::ControllerBase"/>
<class type="sway::Robot" base_class_type="gazebo_ros_control::RobotHWSim"/></library></class_libraries>"""
_MARK = b"\0_ZN12class_loader4impl13registerClassEPKcRKSt9type_infoPFPvvE\0"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "ws/src/sway"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(_MANIFEST)
    (folder / "plugins.xml").write_text(_PLUGINS)
    return folder


def find(package: Path, kind: str = "controller_interface") -> dict[str, Path | None]:
    classes = exported_classes(kind, {"ROS_PACKAGE_PATH": str(package.parent)}, [package])
    return {name: found.library for name, found in classes.items()}


def test_a_class_without_a_library_is_named_with_its_package(package: Path) -> None:
    found = exported_classes("controller_interface", {"ROS_PACKAGE_PATH": str(package.parent)}, [package])["sway/Sway"]

    assert (found.type, found.library) == ("sway::Sway", None)
    with pytest.raises(ParamError, match=r"class in C\+\+ of package sway .* catkin_make compiles it"):
        library_of(found)


def test_the_library_is_in_the_devel_space_and_of_the_kit(package: Path) -> None:
    """One compiled with another class_loader is none: it would bring another roscpp into the process."""
    library = package.parents[1] / "devel/lib/libsway.so"
    library.parent.mkdir(parents=True)
    library.write_bytes(b"ELF class_loader_private")
    assert find(package) == {"sway/Sway": None}

    library.write_bytes(b"ELF" + _MARK)

    assert find(package) == {"sway/Sway": library}


def test_only_classes_with_the_base_are_found_in_readable_descriptions(package: Path) -> None:
    assert find(package, "gazebo_ros_control") == {}
    (package / "package.xml").write_text(_MANIFEST.replace("controller_interface", "gazebo_ros_control"))
    assert find(package, "gazebo_ros_control") == {"sway::Robot": None}
    (package / "plugins.xml").write_text("<library><class")
    assert find(package, "gazebo_ros_control") == {}

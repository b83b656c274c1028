"""Where files live: ROS packages, Gazebo models, worlds and what their URIs mean."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .cmake import CMakeProgram, cmake_programs
    from .gazebo_paths import is_stand_in
    from .manifest import needs
    from .model_config import model_file, refuse_template
    from .packages import ALLOW_OUTSIDE, LENIENT, Packages
    from .repositories import published_at
    from .ros2 import refuse_ros2, refuse_ros2_language
    from .rule_exports import exported_rules
    from .workspace import program_folders

_HOMES = {
    "ALLOW_OUTSIDE": "packages",
    "CMakeProgram": "cmake",
    "LENIENT": "packages",
    "Packages": "packages",
    "cmake_programs": "cmake",
    "exported_rules": "rule_exports",
    "is_stand_in": "gazebo_paths",
    "model_file": "model_config",
    "needs": "manifest",
    "program_folders": "workspace",
    "published_at": "repositories",
    "refuse_ros2": "ros2",
    "refuse_ros2_language": "ros2",
    "refuse_template": "model_config",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "ALLOW_OUTSIDE",
    "LENIENT",
    "CMakeProgram",
    "Packages",
    "cmake_programs",
    "exported_rules",
    "is_stand_in",
    "model_file",
    "needs",
    "program_folders",
    "published_at",
    "refuse_ros2",
    "refuse_ros2_language",
    "refuse_template",
]

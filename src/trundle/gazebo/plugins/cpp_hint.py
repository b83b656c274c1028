"""C++ plugins of the user's packages, which only Gazebo can run."""

from collections.abc import Mapping
from pathlib import Path

from trundle.robots.packages import Packages, cmake_libraries, source_in_container


def compiled_plugin(filename: str, file: Path, environment: Mapping[str, str]) -> str:
    """Return a hint for a plugin that a package around the model's file builds; "" if no package builds it."""
    name = filename.removeprefix("lib").removesuffix(".so")
    for folder in Packages(environment, start=file).ros_packages().values():
        for library in cmake_libraries(folder):
            if library.name == name:
                line = source_in_container(folder, "rosrun gazebo_ros gzserver", environment, needs="gazebo_ros")
                sources = ", ".join(library.sources) or "sources that are not listed there"
                hint = f"; it is C++ that {library.file}:{library.line} builds from {sources}"
                return f"{hint}; Gazebo itself, with it, in a container in place of `trundle run`: {line}"
    return ""

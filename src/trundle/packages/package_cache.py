"""Cache of walks and manifests, kept for all files that one environment reads, as rospack keeps one."""

from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias

from .confinement import WideFolders

Folder: TypeAlias = tuple[Path, str | None]
"""A folder that may be meant by its own name, and the name that its manifest gives it, if it has one."""


class PackageCache:
    """Folders walked and manifests read."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self.wide = WideFolders(environment)
        self.crawls: dict[tuple[Path, int | None], list[Folder]] = {}
        """By where a walk starts and the most folders it looks at."""
        self.installed: list[tuple[Path, str]] | None = None
        """The system's packages; None: not looked for yet."""
        self.skipped: dict[Path, str] = {}
        """Folders that could not be looked into, and why."""
        self.exports: dict[Path, list[dict[str, str]]] = {}
        """Package folder → the attributes of each <gazebo_ros> that it exports."""

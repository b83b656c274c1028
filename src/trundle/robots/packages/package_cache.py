"""Cache of package searches and manifests, shared by all files of one environment, as in rospack."""

from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias

from trundle.base.diagnostics import Source

from .confinement import WideFolders

Folder: TypeAlias = tuple[Path, str | None]
"""Package folder, and the name in its manifest, if any."""


class PackageCache:
    """Results of package searches and manifests."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self.wide = WideFolders(environment)
        self.crawls: dict[tuple[Path, int | None], list[Folder]] = {}
        """(start, max_folders) → package folders."""
        self.installed: list[tuple[Path, str]] | None = None
        """System packages; None: not searched yet."""
        self.skipped: dict[Path, str] = {}
        """Unreadable folders, with the reason."""
        self.added_models: list[Path] = []
        """Folders added to the model path."""
        self.shadowed: dict[str, str] = {}
        """Package → warning of another package of the same name; empty if there is none, or it has been reported."""
        self.moved: dict[str, tuple[Source, str]] = {}
        """Missing file → its first URI's position, and the warning of the file in its place; empty once reported."""
        self.configured: dict[Path, list[Path]] = {}
        """Package folder → files written in place of CMake's `configure_file`."""
        self.exports: dict[Path, list[dict[str, str]]] = {}
        """Package folder → attributes of each exported <gazebo_ros>."""

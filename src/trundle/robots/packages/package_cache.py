"""Cache of package walks and manifests, shared by all files of one environment, as in rospack."""

from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias

from .confinement import WideFolders

Folder: TypeAlias = tuple[Path, str | None]
"""Package folder, and the name in its manifest, if any."""


class PackageCache:
    """Results of folder walks and manifests."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self.wide = WideFolders(environment)
        self.crawls: dict[tuple[Path, int | None], list[Folder]] = {}
        """(start, most folders) → folders found."""
        self.installed: list[tuple[Path, str]] | None = None
        """System packages; None: not searched yet."""
        self.skipped: dict[Path, str] = {}
        """Unreadable folders, with the reason."""
        self.added_models: list[Path] = []
        """Folders of models that were added to the model path."""
        self.passed_over: dict[str, str] = {}
        """Package → sentence on another one of its name; "": there is none, or it was reported."""
        self.configured: dict[Path, list[Path]] = {}
        """Package folder → files that were written for it, as CMake's `configure_file` would."""
        self.exports: dict[Path, list[dict[str, str]]] = {}
        """Package folder → attributes of each exported <gazebo_ros>."""

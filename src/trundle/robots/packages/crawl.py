"""Search of folders for packages, as by rospack."""

import os
from collections import deque
from collections.abc import Iterator
from pathlib import Path

MANIFESTS = ("package.xml", "manifest.xml")
_MAX_DEPTH = 8
"""Maximum depth below a package path; rospack has no limit, published workspaces need five."""
_NOT_CRAWLED = frozenset({"build", "node_modules", "__pycache__"})
_IGNORE_MARKER = "CATKIN_IGNORE"
"""ROS 1's ignore marker; ROS 2's are ignored, as they mark ROS 1 packages in repositories for both."""
_NO_SUBFOLDER_MARKERS = frozenset({*MANIFESTS, "rospack_nosubdirs"})
"""Marker files of folders without packages below."""


class Crawl:
    """Breadth-first walk of folders; folders that cannot be listed are skipped."""

    def __init__(self, root: Path, *, max_folders: int | None = None, max_depth: int = _MAX_DEPTH) -> None:
        """Create a walk.

        Args:
            root: start folder.
            max_folders: maximum folders visited; None: unlimited.
            max_depth: maximum depth below `root`.
        """
        self._root = root
        self.max_folders = max_folders
        self._max_depth = max_depth
        self.skipped: list[tuple[Path, str]] = []
        """Unreadable folders and broken links, with the reason."""

    def __iter__(self) -> Iterator[tuple[Path, set[str]]]:
        """Yield every folder with its entries' names, nearest first; folders inside a package are skipped."""
        pending = deque([(self._root, 0)])
        visited: set[tuple[int, int]] = set()
        count = 0
        while pending and (self.max_folders is None or count < self.max_folders):
            folder, depth = pending.popleft()
            count += 1
            try:
                with os.scandir(folder) as listing:
                    entries = sorted(listing, key=lambda entry: entry.name)
                status = os.stat(folder)
            except OSError as error:
                if not isinstance(error, FileNotFoundError):
                    self.skipped.append((folder, str(error.strerror)))
                continue
            names = {entry.name for entry in entries}
            if _IGNORE_MARKER in names:
                continue
            yield folder, names
            identity = (status.st_dev, status.st_ino)  # a link to a parent folder would repeat it
            if depth < self._max_depth and names.isdisjoint(_NO_SUBFOLDER_MARKERS) and identity not in visited:
                visited.add(identity)
                pending.extend((Path(entry.path), depth + 1) for entry in entries if self._may_hold_packages(entry))

    def _may_hold_packages(self, entry: os.DirEntry[str]) -> bool:
        if entry.name.startswith(".") or entry.name in _NOT_CRAWLED:
            return False
        try:
            return entry.is_dir()
        except OSError as error:
            self.skipped.append((Path(entry.path), str(error.strerror)))
            return False

"""Folder walk for packages, as rospack does."""

import os
from collections import deque
from collections.abc import Iterator
from pathlib import Path

MANIFESTS = ("package.xml", "manifest.xml")
_DEEPEST = 8
"""Largest depth below a package path; rospack has no limit, real workspaces need five."""
_NOT_CRAWLED = frozenset({"build", "node_modules", "__pycache__"})
_IGNORED_BY = "CATKIN_IGNORE"
"""ROS 1's only marker file: robots for both ROS versions keep ROS 1 packages beside the others."""
_ALONE_BY = frozenset({*MANIFESTS, "rospack_nosubdirs"})
"""Marker files of folders without packages below."""


class Crawl:
    """Breadth-first walk of folders; folders that cannot be listed are skipped."""

    def __init__(self, root: Path, *, max_folders: int | None = None, deepest: int = _DEEPEST) -> None:
        """Create a walk.

        Args:
            root: start folder.
            max_folders: most folders visited; None: all.
            deepest: largest depth below `root`.
        """
        self._root = root
        self.most = max_folders
        self._deepest = deepest
        self.skipped: list[tuple[Path, str]] = []
        """Unreadable folders and broken links, with the reason."""

    def __iter__(self) -> Iterator[tuple[Path, set[str]]]:
        """Yield every folder and the names in it, nearest first; folders inside a package are not visited."""
        waiting = deque([(self._root, 0)])
        entered: set[tuple[int, int]] = set()
        looked_at = 0
        while waiting and (self.most is None or looked_at < self.most):
            folder, depth = waiting.popleft()
            looked_at += 1
            try:
                with os.scandir(folder) as listing:
                    entries = sorted(listing, key=lambda entry: entry.name)
                status = os.stat(folder)
            except OSError as error:
                if not isinstance(error, FileNotFoundError):
                    self.skipped.append((folder, str(error.strerror)))
                continue
            names = {entry.name for entry in entries}
            if _IGNORED_BY in names:
                continue
            yield folder, names
            same = (status.st_dev, status.st_ino)  # a link to a parent folder would repeat it
            if depth < self._deepest and names.isdisjoint(_ALONE_BY) and same not in entered:
                entered.add(same)
                waiting.extend((Path(entry.path), depth + 1) for entry in entries if self._may_hold_packages(entry))

    def _may_hold_packages(self, entry: os.DirEntry[str]) -> bool:
        if entry.name.startswith(".") or entry.name in _NOT_CRAWLED:
            return False
        try:
            return entry.is_dir()
        except OSError as error:
            self.skipped.append((Path(entry.path), str(error.strerror)))
            return False

"""Folders below a folder, as rospack looks for packages in them."""

import os
from collections import deque
from collections.abc import Iterator
from pathlib import Path

MANIFESTS = ("package.xml", "manifest.xml")
_DEEPEST = 8
"""How far below a package path packages are looked for; rospack has no bound, real workspaces need five."""
_NOT_CRAWLED = frozenset({"build", "node_modules", "__pycache__"})
_IGNORED_BY = "CATKIN_IGNORE"
"""The only mark of its kind that ROS 1 knows: robots for both keep their ROS 1 packages in folders with the others."""
_ALONE_BY = frozenset({*MANIFESTS, "rospack_nosubdirs"})
"""Below a folder with one of these there are no packages."""


class Crawl:
    """A way through the folders below one; it passes over what cannot be listed."""

    def __init__(self, root: Path, *, max_folders: int | None = None, deepest: int = _DEEPEST) -> None:
        """Get ready.

        Args:
            root: where it starts.
            max_folders: folders that are looked at; None: all.
            deepest: how far below `root`.
        """
        self._root = root
        self.most = max_folders
        self._deepest = deepest
        self.skipped: list[tuple[Path, str]] = []
        """Folders that cannot be listed and links that lead nowhere, and why."""

    def __iter__(self) -> Iterator[tuple[Path, set[str]]]:
        """Every folder and the names in it, the nearest first; what lies inside a package is not looked at."""
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
            same = (status.st_dev, status.st_ino)  # a link to a folder above leads into it again, and again
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

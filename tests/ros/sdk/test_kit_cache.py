"""Compiled kits in the cache: which are kept."""

import os
from pathlib import Path

from trundle.base.file_lock import FileLock
from trundle.ros.sdk.kit_cache import mark_used, note_workspace, trim


def _kit(root: Path, name: str, age_s: int, *, compiler: str = "g++") -> Path:
    folder = root / name
    (folder / "lib").mkdir(parents=True)
    mark_used(folder, compiler)
    os.utime(folder / "ready", (1e9 - age_s, 1e9 - age_s))
    return folder


def test_the_newest_kits_of_each_compiler_and_those_of_workspaces_stay(tmp_path: Path) -> None:
    root, devel = tmp_path / "sdk", tmp_path / "ws/devel"
    devel.mkdir(parents=True)
    used = _kit(root, "used", 100)
    kits = [_kit(root, f"kit{age}", age) for age in range(6)]
    clang = _kit(root, "clang", 1000, compiler="clang++")
    note_workspace(kits[5], devel)
    note_workspace(kits[4], devel)
    note_workspace(kits[4], devel)
    locked = _kit(root, "locked", 2000)
    lock = FileLock(locked)
    (root / "unfinished").mkdir()

    trim(root, used)
    lock.release()

    assert {path.name for path in root.iterdir()} == {
        *("used", "kit0", "kit1", "kit2"),  # four of g++
        "kit4",  # the workspace's; kit5 was its kit before
        *(clang.name, "locked", "unfinished"),
    }
    (devel / ".trundle_kit").unlink()
    trim(root, used)
    assert not kits[4].exists(), "the workspace is gone"


def test_old_unfinished_kits_are_removed(tmp_path: Path) -> None:
    used, old = _kit(tmp_path, "used", 0), tmp_path / "old"
    old.mkdir()
    os.utime(old, (1e9, 1e9))
    trim(tmp_path, used)
    assert [path.name for path in tmp_path.iterdir()] == ["used"]

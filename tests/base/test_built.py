"""Compiled modules of a checkout that do not match its C++ sources."""

from pathlib import Path
from types import ModuleType

import pytest

from trundle.base import built
from trundle.base.diagnostics import TrundleError


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """A module built from two source files."""
    monkeypatch.setattr(built, "_SOURCES", tmp_path / "cpp")
    (tmp_path / "cpp/render").mkdir(parents=True)
    (tmp_path / "cpp/render/a.cc").write_text("int a;")
    (tmp_path / "cpp/render/a.h").write_text("extern int a;")
    (tmp_path / "cpp/render/notes.txt").write_text("not compiled")
    (tmp_path / "sources.sha256").write_text(built._digest(tmp_path / "cpp") or "")
    built._digest.cache_clear()
    module = ModuleType("trundle.sim.render._native")
    module.__file__ = str(tmp_path / "sim/render/_native.so")
    return module


def test_modules_of_the_same_sources_are_accepted(module: ModuleType, tmp_path: Path) -> None:
    built.refuse_stale(module)
    (tmp_path / "cpp/render/notes.txt").write_text("more notes")
    built._digest.cache_clear()
    built.refuse_stale(module)


@pytest.mark.parametrize("change", ["cpp/render/a.cc", "cpp/render/b.h", "sources.sha256"])
def test_modules_of_other_sources_are_refused_with_advice(module: ModuleType, tmp_path: Path, change: str) -> None:
    (tmp_path / change).write_text("int b;")
    message = r"does not match the sources in .*/cpp; build it: make \.venv/\.ready, or pip"
    with pytest.raises(TrundleError, match=message):
        built.refuse_stale(module)


def test_modules_without_a_record_are_refused(module: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "sources.sha256").unlink()
    with pytest.raises(TrundleError, match="build it"):
        built.refuse_stale(module)


def test_modules_of_an_installed_wheel_are_accepted(module: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "cpp").rename(tmp_path / "elsewhere")
    (tmp_path / "sources.sha256").unlink()
    built.refuse_stale(module)

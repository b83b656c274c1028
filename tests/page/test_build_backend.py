"""The build backend: builds the page's client if it is missing, then runs scikit-build-core."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

WEB = Path(__file__).parents[2] / "web"


@pytest.fixture
def calls() -> list[str]:
    """Recorded calls, in order."""
    return []


@pytest.fixture
def backend(calls: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The backend with fakes of scikit-build-core and npm that record calls."""
    core = ModuleType("scikit_build_core")
    core.build = ModuleType("build")  # pyright: ignore[reportAttributeAccessIssue]
    for kind in ("wheel", "editable", "sdist"):
        setattr(core.build, f"build_{kind}", lambda *_, kind=kind: calls.append(kind) or f"{kind}.file")
        setattr(core.build, f"get_requires_for_build_{kind}", lambda *_: ["ninja"])
        setattr(core.build, f"prepare_metadata_for_build_{kind}", lambda *_: "info")
    monkeypatch.setitem(sys.modules, "scikit_build_core", core)
    spec = importlib.util.spec_from_file_location("build_backend", WEB / "build_backend.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "CLIENT", tmp_path / "index.html")
    return module


def install_npm(monkeypatch: pytest.MonkeyPatch, calls: list[str], *, code: int, client: Path | None = None) -> None:
    """Install a module `npm` that records its calls and returns an exit code."""

    def npm(*words: str) -> int:
        calls.append(words[0])
        if client is not None and words[0] == "run":
            client.touch()
        return code

    module = ModuleType("npm")
    module.npm = npm  # pyright: ignore[reportAttributeAccessIssue]
    monkeypatch.setitem(sys.modules, "npm", module)


@pytest.mark.parametrize("kind", ["wheel", "editable", "sdist"])
def test_a_missing_client_is_built_first(
    kind: str, backend: ModuleType, calls: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    install_npm(monkeypatch, calls, code=0, client=backend.CLIENT)

    assert getattr(backend, f"get_requires_for_build_{kind}")() == ["ninja", backend.NODE]
    assert getattr(backend, f"build_{kind}")("out") == f"{kind}.file"
    assert calls == ["ci", "run", kind]


@pytest.mark.parametrize("kind", ["wheel", "editable", "sdist"])
def test_an_existing_client_needs_no_node(kind: str, backend: ModuleType, calls: list[str]) -> None:
    backend.CLIENT.touch()

    assert getattr(backend, f"get_requires_for_build_{kind}")() == ["ninja"]
    assert getattr(backend, f"build_{kind}")("out") == f"{kind}.file"
    assert calls == [kind]


def test_without_npm_only_the_client_is_missing(
    backend: ModuleType, calls: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    install_npm(monkeypatch, calls, code=1)

    assert backend.build_wheel("out") == "wheel.file"
    assert calls == ["ci", "wheel"]
    assert "the page's client is not built (npm ci --fetch-retries=1 --fetch-timeout=20000 failed)" in (
        capsys.readouterr().err
    )


def test_without_node_only_the_client_is_missing(
    backend: ModuleType, calls: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "npm", None)

    assert backend.build_wheel("out") == "wheel.file"
    assert calls == ["wheel"]
    assert "the page's client is not built (import of npm halted" in capsys.readouterr().err

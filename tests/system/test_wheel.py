"""The wheel built by `make dist`, in a new environment outside the checkout, is complete and runs."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.docs_blocks import PAGES, ROOT, has_blocks, run_page

from trundle import __version__

SEEDS = ROOT.parent / "shared/seeds"
WHEELS = sorted((ROOT / "dist").glob("trundle-*.whl"))
ROSPY = sorted((ROOT / "dist").glob("trundle_rospy-*.whl"))
CLIENT = "src/trundle/page/client/"
"""The built client, which is not in the repository."""
TIMEOUT_S = 300.0

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not WHEELS, reason="there is no wheel in dist/; `make dist` builds one"),
]

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def commands(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the programs of an environment with the wheel."""
    return _installed(tmp_path_factory.mktemp("installed") / "venv", WHEELS[-1])


def _installed(folder: Path, *wheels: Path) -> Path:
    """Install wheels in a new environment with the test's dependencies except trundle; return its programs' folder."""
    subprocess.run([sys.executable, "-m", "venv", folder], check=True, timeout=TIMEOUT_S)
    python = next(folder.glob("bin/python")) if os.name == "posix" else folder / "Scripts/python.exe"
    install = [python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", *wheels]
    subprocess.run(install, check=True, timeout=TIMEOUT_S)
    packages = next(folder.rglob("trundle-*.dist-info")).parent
    # Plain paths of a .pth file come after the environment's own packages, and their .pth files are not read.
    (packages / "dependencies.pth").write_text(sysconfig.get_paths()["purelib"])
    return python.parent


@pytest.fixture
def run(commands: Path, tmp_path: Path) -> Run:
    """Run a program of the environment in an empty folder, without settings."""

    def call(name: str, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
        kept = {key: os.environ[key] for key in ("SYSTEMROOT", "TEMP", "TMPDIR") if key in os.environ}
        environment = {**kept, "HOME": str(tmp_path), "PATH": f"{commands}{os.pathsep}{os.defpath}", **variables}
        command = [str(commands / name), *arguments]
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )

    return call


def result(done: subprocess.CompletedProcess[str]) -> dict[str, Any]:
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_every_file_of_the_package_is_in_the_wheel() -> None:
    """Also stubs, which the lazy packages read at run time, and py.typed."""
    package = ROOT / "src"
    sources = {str(file.relative_to(package).as_posix()) for file in package.rglob("*") if file.is_file()}
    with zipfile.ZipFile(WHEELS[-1]) as wheel:
        missing = {name for name in sources - set(wheel.namelist()) if not name.endswith((".pyc", ".so"))}

    assert missing == set()
    assert {"trundle/py.typed", "trundle/ros/__init__.pyi", "trundle/sim/render/_native.pyi"} <= sources


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="this is no checkout")
def test_the_sdist_has_only_files_of_the_repository() -> None:
    command = ["git", "-C", str(ROOT), "ls-files"]
    tracked = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    with tarfile.open(next((ROOT / "dist").glob("trundle-*.tar.gz"))) as sdist:
        packed = {name.partition("/")[2] for name in sdist.getnames()}

    assert {name for name in packed - set(tracked) if not name.startswith(CLIENT)} == {"PKG-INFO"}
    assert {"CMakeLists.txt", "cpp/render/kernel.cc", "examples/rp2w/model.sdf", "src/trundle/py.typed"} <= packed


def test_the_page_s_client_is_in_sdist_and_wheel() -> None:
    """Complete, so that neither needs Node; with licences, but without build dependencies."""
    with tarfile.open(next((ROOT / "dist").glob("trundle-*.tar.gz"))) as sdist:
        packed = {name.partition("/")[2] for name in sdist.getnames()}
    with zipfile.ZipFile(WHEELS[-1]) as wheel:
        installed = {f"src/{name}" for name in wheel.namelist()}
        document = wheel.read("trundle/page/client/index.html").decode()
        licenses = wheel.read("trundle/page/client/licenses.txt").decode()

    client = {name for name in packed if name.startswith(CLIENT)}
    assert client == {name for name in installed if name.startswith(CLIENT)}
    named = set(re.findall(r'(?:src|href)="\./([^"]+)"', document))
    assert any(name.endswith(".js") for name in named)
    assert {f"{CLIENT}{name}" for name in named} <= client
    assert "preact" in licenses
    assert not [name for name in packed | installed if "node_modules" in name]


def test_trundle_is_imported_from_the_wheel(run: Run, commands: Path) -> None:
    done = run("python", "-c", "import trundle; print(trundle.__file__)")

    assert Path(done.stdout).is_relative_to(commands.parent)


def test_every_module_of_the_wheel_imports(run: Run) -> None:
    code = """
import importlib, pkgutil, trundle
from trundle.ros.rospy.finder import install
install()  # as in all ROS programs: genpy etc. are found
for module in pkgutil.walk_packages(trundle.__path__, "trundle."):
    try:
        importlib.import_module(module.name)
    except ModuleNotFoundError as error:
        if error.name not in ("mujoco_warp", "warp"):  # by hand: trundle doctor says how
            raise
"""
    done = run("python", "-W", "ignore", "-c", code)

    assert done.returncode == 0, done.stderr


def test_the_trundle_rospy_wheel_provides_rospy(tmp_path: Path) -> None:
    python = _installed(tmp_path / "venv", WHEELS[-1], ROSPY[-1]) / "python"
    code = "import rospy, tf, std_msgs.msg; print(rospy.__file__, std_msgs.msg.String('a'))"
    done = subprocess.run(
        [python, "-c", code],
        cwd=tmp_path,
        env={"HOME": str(tmp_path), "PATH": os.defpath},
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )

    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(str(tmp_path))
    assert done.stdout.endswith('data: "a"\n')
    packages = next((tmp_path / "venv").rglob("trundle-*.dist-info")).parent
    assert not {"rospy", "tf", "std_msgs"} & {entry.name for entry in packages.iterdir()}


def test_the_gazebo_tutorial_runs(run: Run) -> None:
    """With the model of the shared folder if present, else with the wheel's model."""
    variables = {"GAZEBO_MODEL_PATH": str(SEEDS)} if SEEDS.is_dir() else {}

    final = result(
        run("trundle", "run", "model://rp2w", "--headless", "--no-ros", "--duration", "2", "--json", **variables)
    )

    (robot,) = [model for model in final["models"] if not model.get("added")]
    assert final["time"] == pytest.approx(2.0)
    assert robot["pose"][2] == pytest.approx(0.0, abs=0.05)


def test_the_ros_tutorial_launches(run: Run) -> None:
    """With the package of the shared folder if present, else with the wheel's package."""
    words = ("smartcar_description", "smartcar_display.rviz.launch") if SEEDS.is_dir() else ("smartcar", "drive.launch")
    variables = {"ROS_PACKAGE_PATH": str(SEEDS)} if SEEDS.is_dir() else {}

    done = run("trundle", "launch", *words, "--headless", "--duration", "3", "--port", "0", **variables)

    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stdout + done.stderr


def test_the_wheel_renders(run: Run, tmp_path: Path) -> None:
    done = run("trundle", "render", "rp2w_at_home.world", "-o", "home.png")

    assert done.returncode == 0, done.stderr
    assert (tmp_path / "home.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("page", [page for page in PAGES if has_blocks(page)], ids=lambda page: page.name)
def test_code_blocks_of_the_documentation_run(page: Path, commands: Path, tmp_path: Path) -> None:
    run_page(page, tmp_path, commands=commands)


@pytest.mark.skipif(not (ROOT / "packaging").is_dir(), reason="the check of a wheel is not part of the sdist")
def test_the_check_of_each_wheel_passes(commands: Path, tmp_path: Path) -> None:
    """As the workflow runs it; here with the dependencies of this environment."""
    command = [str(commands / "python"), str(ROOT / "packaging/check_wheel.py")]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)

    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.endswith("all checks passed\n")


@pytest.mark.skipif(shutil.which("uvx") is None, reason="uvx is not installed")
def test_uvx_runs_the_wheel(tmp_path: Path) -> None:
    command = ["uvx", "--python", sys.executable, "--from", str(WHEELS[-1]), "trundle", "--version"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=600, check=False)
    if "fetch" in done.stderr.lower():
        pytest.skip("uvx reaches no package index from here")

    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == f"trundle {__version__}"

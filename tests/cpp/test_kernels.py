"""The C++ kernels by themselves: boxes, rays, contacts, controllers' laws, graphs of poses, navigation, arms."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BUILT = ROOT / "build/kernel_tests"
MISSING = [name for name in ("cmake", "g++") if shutil.which(name) is None]
HEADER = next((path for path in ("/usr/include", "/usr/local/include", "/opt/homebrew/include")
               if Path(path, "doctest/doctest.h").is_file()), None)  # fmt: skip


@pytest.mark.slow
@pytest.mark.skipif(not (ROOT / "cpp").is_dir(), reason="the C++ sources are not here")
@pytest.mark.skipif(bool(MISSING), reason=f"{' and '.join(MISSING)} not installed")
@pytest.mark.skipif(HEADER is None, reason="doctest's header is not installed (`make system` does)")
def test_the_kernels_pass_their_tests() -> None:
    """Built in `build`, so that the next run compiles only changed files."""
    configure = ["cmake", "-S", str(ROOT), "-B", str(BUILT), "-D", "TRUNDLE_TESTS=ON", "-D", "CMAKE_BUILD_TYPE=Debug"]
    for command in (
        [*configure, "-D", f"Python_EXECUTABLE={sys.executable}"],
        ["cmake", "--build", str(BUILT), "--parallel", "2"],
    ):
        built = subprocess.run(command, capture_output=True, text=True, check=False)
        assert built.returncode == 0, built.stdout[-4000:] + built.stderr[-4000:]
    ran = subprocess.run([str(BUILT / "tests/cpp/kernel_tests")], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout[-4000:]

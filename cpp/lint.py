"""Runs clang-format or clang-tidy over the C++: `lint.py format [--check]`, `lint.py tidy [--changed]`.

Each tool comes from this Python's environment or from PATH; if it is not installed, a line says so and nothing fails.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDERS = (
    "cpp/*",
    "sdk/*/src",
    "sdk/*/include",
    "sdk/*/include/*",
    "sdk/*/include/*/*",
    "tests/sim/render",
    "tests/cpp",
    "bench",
)
OPTIONS = ["-std=gnu++20", "-DTRUNDLE_ISA=baseline", "-Wcomma"]


def main(command: str, *options: str) -> int:
    """Run clang-format or clang-tidy; return the exit code."""
    tool = _find(f"clang-{command}")
    if tool is None:
        print(f"clang-{command} is not installed: skipped")
        return 0
    if command == "format":
        files = [file for folder in FOLDERS for file in sorted(ROOT.glob(f"{folder}/*.[ch]*")) if _is_cpp(file)]
        mode = ["--dry-run", "--Werror"] if "--check" in options else ["-i"]
        return subprocess.run([tool, *mode, *files], check=False).returncode
    return _tidy(tool, _changed() if "--changed" in options else sorted((ROOT / "cpp").glob("*/*.cc")))


def _tidy(tool: str, files: list[Path]) -> int:
    includes = _includes()
    if includes is None:
        print("clang-tidy needs the headers of mujoco-core and nanobind: skipped (`make tidy` installs them)")
        return 0

    def check(file: Path) -> int:
        command = [tool, "--quiet", str(file), "--", *OPTIONS, *includes]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            print(done.stdout, done.stderr, sep="")
        return done.returncode

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return max(pool.map(check, files), default=0)


def _changed() -> list[Path]:
    """Sources that differ from HEAD: all of them take longer than `make check` should."""
    command = ["git", "-C", str(ROOT), "status", "--porcelain", "--untracked-files=all", "--", "cpp"]
    listed = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    return [
        file
        for line in listed.splitlines()
        if (file := ROOT / line[3:].split(" -> ")[-1]).suffix == ".cc" and file.is_file()
    ]


def _includes() -> list[str] | None:
    folders = [str(ROOT / "cpp"), sysconfig.get_paths()["include"]]
    for package in ("mujoco", "nanobind"):
        spec = importlib.util.find_spec(package)
        if spec is None or not spec.submodule_search_locations:
            return None
        folders.append(f"{spec.submodule_search_locations[0]}/include")
    return [word for folder in folders for word in ("-isystem", folder)]


def _find(name: str) -> str | None:
    local = shutil.which(name, path=str(Path(sys.executable).parent))
    return local or shutil.which(name)


def _is_cpp(file: Path) -> bool:
    return file.suffix in (".cc", ".cpp", ".h", ".hh")


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

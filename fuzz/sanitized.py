"""C++ libraries with AddressSanitizer and UndefinedBehaviorSanitizer, built into build/sanitized."""

import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ExtensionFileLoader, ModuleSpec
from pathlib import Path
from types import ModuleType

from .target import ROOT

_FOLDER = ROOT / "build" / "sanitized"
_FLAGS = "-fsanitize=address,undefined,fuzzer-no-link -fno-sanitize=vptr,function -fno-omit-frame-pointer"
"""fuzzer-no-link counts edges; vptr and function are not in runtimes of other versions of clang."""
_MODULES = {
    "trundle.sim.render._native": "_native",
    "trundle.sim.physics._contact_laws": "_contact_laws",
    "trundle.ros._message_codec": "_message_codec",
}


def build() -> Path | None:
    """Build outdated libraries; without clang print a message and return None."""
    if shutil.which("clang++") is None:
        print("fuzz: clang++ is not installed: the C++ runs without sanitizers", file=sys.stderr)
        return None
    built = _FOLDER / "cmake"
    digest = _sources_digest()
    if not (built / "built").is_file() or (built / "built").read_text() != digest:
        print("fuzz: building the C++ with sanitizers …", file=sys.stderr)
        command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check", "--no-deps"]
        command += ["--constraint", "constraints.txt", "--wheel-dir", str(_FOLDER), "-C", f"build-dir={built}"]
        command += ["-C", "cmake.build-type=RelWithDebInfo", "-C", f"cmake.define.CMAKE_CXX_FLAGS={_FLAGS}", "."]
        subprocess.run(command, cwd=ROOT, env={**os.environ, "CXX": "clang++"}, check=True)
        shutil.copy(built / "sources.sha256", _FOLDER)  # read by trundle.base.built
        (built / "built").write_text(digest)
    return built


def environment() -> dict[str, str]:
    """Return the environment variables of a process that loads the libraries."""
    return {
        "LD_PRELOAD": str(_runtime()),
        "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1:handle_abort=0:abort_on_error=0",
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "PYTHONMALLOC": "malloc",
    }


def use_sanitized(built: Path) -> None:
    """Import the compiled modules from the built libraries."""
    sys.meta_path.insert(0, _Finder(built))


class _Finder(MetaPathFinder):
    def __init__(self, built: Path) -> None:
        self._built = built

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        del path, target
        if fullname not in _MODULES:
            return None
        file = next(self._built.glob(f"{_MODULES[fullname]}.*.so"))
        return importlib.util.spec_from_file_location(fullname, file, loader=ExtensionFileLoader(fullname, str(file)))


def _runtime() -> Path:
    """Return the library to preload: Atheris' library contains libFuzzer, which counts edges."""
    spec = importlib.util.find_spec("atheris")
    if spec is not None and spec.origin is not None:
        return Path(spec.origin).parents[1] / "asan_with_fuzzer.so"
    command = ["clang++", "-print-file-name=libclang_rt.asan-x86_64.so"]
    return Path(subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip())


def _sources_digest() -> str:
    files = [ROOT / "CMakeLists.txt", *sorted((ROOT / "cpp").glob("*/*.[ch]*"))]
    return hashlib.sha256(b"".join([_FLAGS.encode(), *(file.read_bytes() for file in files)])).hexdigest()

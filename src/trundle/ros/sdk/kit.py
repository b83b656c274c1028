"""The development kit: its sources, and its libraries, compiled once per compiler into the user's cache."""

import errno
import hashlib
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from trundle.assets import ASSETS
from trundle.base.diagnostics import UsageError
from trundle.base.file_lock import FileLock
from trundle.base.ownership import home_folder, is_owned_by_user

from . import message_header
from .headers import Headers
from .kit_cache import READY, mark_used, note_workspace, trim
from .toolchain import Toolchain, codec_headers
from .zig import zig_definitions

_ROOT = Path(message_header.__file__).parents[4]
_INSTALLED = Path(message_header.__file__).parents[2] / "sdk"
GAZEBO_CMAKE = next((path for path in (_INSTALLED, _ROOT / "sdk") if path.is_dir()), _INSTALLED) / "gazebo/cmake"
"""Folder in which CMake's find_package finds the kit's Gazebo."""
_LOG_LINES = 30
_STATUS = re.compile(r"\[(?P<built>\d+)/(?P<total>\d+)\] ")
_POLL_S = 0.5


class Kit(NamedTuple):
    """Compiled kit."""

    sources: Path
    """Folder of the sources, with a folder for each package."""
    folder: Path
    """Folder with `lib`, the compiled libraries, and `include`, the generated headers of messages."""


def kit_sources() -> Path:
    """Return the folder of the kit's sources: the wheel's, or a checkout's."""
    folder = next((path for path in (_INSTALLED, _ROOT / "sdk") if (path / "CMakeLists.txt").is_file()), None)
    if folder is None:
        raise UsageError(f"the C++ development kit is not installed: {_INSTALLED} is missing")
    return folder


def compiled_kit(
    toolchain: Toolchain, environment: Mapping[str, str], *, flags: str = "", jobs: str | None = None
) -> Kit:
    """Return the kit for a compiler; it is compiled on first use, which takes minutes and is told on stderr.

    Args:
        toolchain: compiler and tools.
        environment: environment variables; XDG_CACHE_HOME names the folder of caches.
        flags: additional flags of the compiler, such as -fsanitize=address.
        jobs: number of compilers that run at the same time; None: one for each processor.

    Raises:
        UsageError: the kit cannot be compiled; the text ends with the compiler's output.
    """
    sources = kit_sources()
    root = Path(environment.get("XDG_CACHE_HOME") or home_folder(environment) / ".cache") / "trundle" / "sdk"
    try:
        root.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not is_owned_by_user(root):
            raise UsageError(f"{root} is writable by another user, who could replace the libraries in it; remove it")
        folder = root / _digest(sources, toolchain, flags)
        folder.mkdir(exist_ok=True)
        lock = _lock(folder)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    try:
        if not (folder / READY).exists():
            _compile(sources, folder, toolchain, environment, flags, jobs)
        mark_used(folder, f"{toolchain.compiler}\n{toolchain.version}")
        trim(root, folder)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    finally:
        lock.release()
    return Kit(sources, folder)


def _lock(folder: Path) -> FileLock:
    """Lock a folder; wait for a build that compiles the kit there."""
    is_told = False
    while True:
        try:
            return FileLock(folder)
        except OSError as error:
            if error.errno != errno.EBUSY:
                raise
        if not is_told:
            print("-- waiting for another build, which compiles the C++ development kit", file=sys.stderr, flush=True)
            is_told = True
        time.sleep(_POLL_S)


def link_programs(kit: Kit, packages: Mapping[str, Path], devel: Path) -> None:
    """Link the kit's programs, such as nodelet, into a devel space whose packages depend on theirs.

    Args:
        kit: compiled kit.
        packages: name → folder of the workspace's packages.
        devel: devel space, whose kit this is from now on.

    Raises:
        UsageError: a file cannot be written.
    """
    try:
        note_workspace(kit.folder, devel)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    manifests = [(folder / "package.xml").read_text(encoding="utf-8", errors="replace") for folder in packages.values()]
    for program in sorted(kit.folder.glob("lib/*/*")):
        package = program.parent.name
        if not any(re.search(rf">\s*{package}\s*</\w*depend>", manifest) for manifest in manifests):
            continue
        link = devel / "lib" / package / program.name
        link.parent.mkdir(parents=True, exist_ok=True)
        if link.is_symlink() and link.readlink() != program:
            link.unlink()
        if not os.path.lexists(link):
            link.symlink_to(program)


def _compile(
    sources: Path, folder: Path, toolchain: Toolchain, environment: Mapping[str, str], flags: str, jobs: str | None
) -> None:
    print("-- compiling the C++ development kit, once for this compiler", file=sys.stderr, flush=True)
    headers = Headers({}, folder / "include", folder / "include", provided=sources)
    headers.write_included([sources])
    build = folder / "build"
    if _is_of_another_folder(build, sources):
        shutil.rmtree(build)
    configure = [
        *(toolchain.cmake, "-S", sources, "-B", build, "-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={toolchain.ninja}"),
        *(f"-DCMAKE_CXX_COMPILER={toolchain.compiler}", f"-DCMAKE_CXX_FLAGS={flags}"),
        *(f"-DTRUNDLE_MESSAGES={folder / 'include'}", f"-DCMAKE_INSTALL_PREFIX={folder}"),
        *([] if toolchain.boost is None else [f"-DTRUNDLE_BOOST={toolchain.boost / 'include'}"]),
        *([] if toolchain.eigen is None else [f"-DTRUNDLE_EIGEN={toolchain.eigen / 'include/eigen3'}"]),
        *zig_definitions(toolchain.compiler),
    ]
    install = [toolchain.ninja, "-C", build, *([] if jobs is None else ["-j", jobs]), "install"]
    for command in (configure, install):
        code, lines = _run(command, environment)
        if code:
            log = "\n".join(lines[-_LOG_LINES:])
            raise UsageError(f"the C++ development kit cannot be compiled by {toolchain.compiler}:\n{log}")
    shutil.rmtree(build, ignore_errors=True)


def _is_of_another_folder(build: Path, sources: Path) -> bool:
    """True if an unfinished build has the sources of another environment, which CMake refuses to go on with."""
    with suppress(FileNotFoundError):
        lines = (build / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace").splitlines()
        return f"CMAKE_HOME_DIRECTORY:INTERNAL={sources.as_posix()}" not in lines
    return False


def _run(command: Sequence[str | Path], environment: Mapping[str, str]) -> tuple[int, list[str]]:
    """Run a tool; print how much Ninja has built, on a terminal on one line, else at each tenth."""
    lines: list[str] = []
    on_terminal, tenth = sys.stderr.isatty(), 0
    with subprocess.Popen(
        command,
        env={**environment, "NINJA_STATUS": "[%f/%t] "},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            lines.append(line.rstrip())
            if (status := _STATUS.match(line)) is None:
                continue
            built, total = int(status["built"]), int(status["total"])
            if on_terminal:
                print(f"\r--   {built} of {total} ", end="\n" if built == total else "", file=sys.stderr, flush=True)
            elif (reached := 10 * built // max(total, 1)) > tenth:
                tenth = reached
                print(f"--   {built} of {total}", file=sys.stderr, flush=True)
    return process.returncode, lines


def _digest(sources: Path, toolchain: Toolchain, flags: str) -> str:
    """Return a name that depends on the sources, compiler and flags: each release of Trundle compiles its own kit."""
    libraries = f"{toolchain.boost}\n{toolchain.eigen}\n{codec_headers()}"
    compiler = f"{toolchain.compiler}\n{toolchain.version}\n{flags}\n{libraries}"
    digest = hashlib.sha256(compiler.encode())
    generator = Path(message_header.__file__)
    for path in [generator, *sorted(path for path in sources.rglob("*") if path.is_file())]:
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def header_packages() -> list[str]:
    """Return the packages without a C++ library to link: those of messages, of Python and of tools.

    A package with messages and a library, such as navfn, is not among them.
    """
    messages = [*(ASSETS / "messages/definitions").iterdir(), *(ASSETS / "messages/standard").iterdir()]
    messages += (ASSETS / "messages/published").iterdir()
    python = Path(message_header.__file__).parents[1] / "rospy/modules"
    return sorted({*(path.stem for path in (*messages, *python.iterdir())), *_TOOLS} - _LIBRARIES_OF_NAVIGATION)


_TOOLS = frozenset(
    {
        *("catkin", "cmake_modules", "gencpp", "genlisp", "message_generation", "message_runtime"),
        *("ros_environment", "rosbash", "rosdoc_lite", "roslint", "rosmaster", "xacro"),
        *("joint_state_publisher", "joint_state_publisher_gui", "rqt_gui_py"),
    }
)
"""Packages of programs and of catkin's generators, which manifests name, and nothing is linked with."""
_LIBRARIES_OF_NAVIGATION = frozenset({"base_local_planner", "costmap_2d", "navfn", "teb_local_planner"})
"""Packages with messages that Trundle has, and with libraries that it has not."""

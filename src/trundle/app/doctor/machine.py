"""Checks of the programs and libraries of this machine."""

import os
import platform
import shutil
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec

from trundle.base.diagnostics import UsageError
from trundle.ros.sdk import find_toolchain
from trundle.sim.physics import NoGpuError, find_gpu

from .check import Check

_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "firefox", "epiphany", "safari", "msedge")
_BAD_MUJOCO = "4.0.0"
"""Version of MuJoCo whose sparse Newton factor is wrong."""
_EXTRAS = {
    "av": ("video", "videos cannot be written; pip install 'trundle[video]'"),
    "OpenGL": ("egl", "--renderer egl is not available, the CPU's is; pip install 'trundle[egl]'"),
}


def machine_checks(environment: Mapping[str, str]) -> Iterator[Check]:
    """Yield findings on Python, physics, compiler, ROS, browser and terminal."""
    yield Check(
        name="machine", state="ok", found=f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors"
    )
    yield Check(name="python", state="ok", found=f"{platform.python_version()} ({sys.executable})")
    yield Check(name="trundle", state="ok", found=version("trundle"))
    yield _mujoco()
    for module, (extra, cost) in _EXTRAS.items():
        if find_spec(module) is not None:
            yield Check(name=extra, state="ok", found=module)
        else:
            yield Check(name=extra, state="missing", found="not installed", cost=cost)
    yield _gpu()
    path = environment.get("PATH", os.defpath)
    yield _compiler(environment)
    yield _ros(environment)
    yield _browser(environment, path)
    yield _terminal(environment)


def _mujoco() -> Check:
    try:
        found = version("mujoco-core")
    except PackageNotFoundError:
        return Check(name="mujoco", state="problem", found="not installed", cost="nothing can be simulated")
    with suppress(PackageNotFoundError):
        both = f"mujoco-core {found} and mujoco {version('mujoco')}"
        cost = f"they write the same files: pip uninstall mujoco mujoco-core && pip install mujoco-core=={found}"
        return Check(name="mujoco", state="problem", found=both, cost=cost)
    if found == _BAD_MUJOCO:
        return Check(name="mujoco", state="problem", found=found, cost="its contacts are wrong; install 4.0.1 or newer")
    return Check(name="mujoco", state="ok", found=found)


def _gpu() -> Check:
    try:
        return Check(name="gpu", state="ok", found=find_gpu())
    except NoGpuError as error:
        cost = f"many worlds at once are stepped by the processors: {error}"
        return Check(name="gpu", state="missing", found="none for physics", cost=cost)


def _compiler(environment: Mapping[str, str]) -> Check:
    try:
        toolchain = find_toolchain(environment)
    except UsageError as error:
        cost = "C++ nodes and plugins cannot be compiled here; Python ones and those that come with Trundle need none"
        return Check(name="compiler", state="missing", found=str(error), cost=cost)
    release = toolchain.version.partition("\n")[0]
    return Check(name="compiler", state="ok", found=f"{toolchain.compiler}: {release}")


def _ros(environment: Mapping[str, str]) -> Check:
    """Check for the tools of an installed ROS 1, without those of `trundle shell`."""
    shell_folder = environment.get("TRUNDLE_SHELL", "")
    folders = [
        f
        for f in environment.get("PATH", "").split(os.pathsep)
        if f and not (shell_folder and f.startswith(shell_folder))
    ]
    installed = shutil.which("rostopic", path=os.pathsep.join([*folders, "/opt/ros/noetic/bin"]))
    if installed is None:
        cost = "programs compiled for it do not run; C++ compiled here, trundle's commands and stand-ins need no ROS"
        return Check(name="ros", state="missing", found="not installed", cost=cost)
    return Check(name="ros", state="ok", found=f"{os.path.dirname(installed)}; its nodes and tools join the same graph")


def _browser(environment: Mapping[str, str], path: str) -> Check:
    """Check for a browser that can show the page; only the page can check WebGL."""
    found = next((program for name in _BROWSERS if (program := shutil.which(name, path=path))), None)
    is_desktop = sys.platform in ("darwin", "win32")
    if is_desktop or (found is not None and (environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"))):
        return Check(name="browser", state="ok", found=found or "the system's")
    cost = "open the page on another machine: ssh -L 8080:localhost:8080 HERE; it needs WebGL 2, and says so"
    return Check(name="browser", state="missing", found=f"{found}, no display" if found else "none", cost=cost)


def _terminal(environment: Mapping[str, str]) -> Check:
    encoding = getattr(sys.stdout, "encoding", None) or "unknown"
    size = shutil.get_terminal_size()
    found = f"{environment.get('TERM', 'no TERM')}, {encoding}, {size.columns}x{size.lines}"
    if encoding.lower().replace("-", "") != "utf8":
        return Check(
            name="terminal", state="missing", found=found, cost="some characters are escaped; set LANG=C.UTF-8"
        )
    return Check(name="terminal", state="ok", found=found)

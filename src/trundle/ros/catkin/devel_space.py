"""The devel space: files that a shell sources to find a workspace's packages."""

import os
import shlex
from collections.abc import Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError

from .workspace import Workspace

_CATKIN_FILE = "_setup_util.py"
"""File that marks a devel space of catkin itself, whose setup files are kept."""
_TOOL = "catkin_make"
_SETUP_FILES = Path(__file__).with_name("setup_files")


def write_devel_space(workspace: Workspace, environment: Mapping[str, str]) -> bool:
    """Write the marker and setup files of a workspace; return False if catkin itself wrote them, and keep those.

    Raises:
        UsageError: another tool built the workspace, or a file cannot be written.
    """
    devel, build = workspace.devel, workspace.build
    try:
        for space in (build, devel):
            space.mkdir(exist_ok=True)
            _mark(space)
        (workspace.base / ".catkin_workspace").touch()
        is_catkins = (devel / _CATKIN_FILE).exists()
        (devel / "lib").mkdir(exist_ok=True)
        if not is_catkins:
            for name, text in _files(workspace, environment).items():
                path = devel / name
                write_atomically(path, text)
                path.chmod(0o755 if name.endswith((".sh", ".bash", ".zsh")) else 0o644)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    return not is_catkins


def _mark(space: Path) -> None:
    """Write the file in which catkin's tools note the tool that built a space."""
    marker = space / ".built_by"
    tool = marker.read_text(encoding="utf-8", errors="replace").strip() if marker.is_file() else _TOOL
    if tool != _TOOL:
        raise UsageError(
            f"The {space.name} space at '{space}' was previously built by '{tool}'. Please remove the {space.name} "
            f"space or pick a different {space.name} space."
        )
    marker.write_text(_TOOL)


def _files(workspace: Workspace, environment: Mapping[str, str]) -> dict[str, str]:
    devel = workspace.devel
    values = {
        "@DEVEL@": shlex.quote(str(devel)),
        "@UNDERLAYS@": shlex.quote(os.pathsep.join(underlays(devel, environment))),
    }
    files = {".catkin": str(workspace.source), ".rosinstall": f"- setup-file: {{local-name: {devel}/setup.sh}}\n"}
    for name in ("setup.sh", "setup.bash", "setup.zsh", "env.sh"):
        text = (_SETUP_FILES / name).read_text(encoding="utf-8")
        for variable, value in values.items():
            text = text.replace(variable, value)
        files[name] = text
    for shell in ("sh", "bash", "zsh"):
        local = f"CATKIN_SETUP_UTIL_ARGS='--extend --local'\n{_sourced(devel, shell)}\nunset CATKIN_SETUP_UTIL_ARGS\n"
        files[f"local_setup.{shell}"] = f"# This workspace only, without those below it.\n{local}"
    return files


def _sourced(devel: Path, shell: str) -> str:
    return f". {shlex.quote(str(devel / f'setup.{shell}'))}"


def underlays(devel: Path, environment: Mapping[str, str]) -> list[str]:
    """Return the workspaces on CMAKE_PREFIX_PATH other than this one."""
    prefixes = environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    return [prefix for prefix in prefixes if prefix and Path(prefix) != devel]

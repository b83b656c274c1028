"""Log folders as in ROS: one per run, and the link `latest` to the last."""

import contextlib
import os
import socket
from collections.abc import Mapping
from pathlib import Path
from tempfile import mkdtemp

from trundle.base.diagnostics import UsageError
from trundle.base.http.access import without_tokens
from trundle.base.ownership import home_folder, is_owned_by_user
from trundle.ros import PYTHON_LOG_BACKUPS, PYTHON_LOG_BYTES, LogFile, python_log_line


def ros_home(env: Mapping[str, str]) -> Path:
    """ROS_HOME, or ~/.ros; the working directory of nodes."""
    return Path(env.get("ROS_HOME") or home_folder(env) / ".ros")


def log_folder(env: Mapping[str, str], run_id: str) -> Path:
    """Create the log folder of one run, from ROS_LOG_DIR and ROS_HOME.

    Raises:
        UsageError: it cannot be created.
    """
    parent = Path(env.get("ROS_LOG_DIR") or ros_home(env) / "log")
    folder = parent / (run_id or "trundle")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not is_owned_by_user(folder):  # in a shared folder such as /tmp, another user may have made it
            folder = Path(mkdtemp(prefix=f"{folder.name}-", dir=parent))
        ros_home(env).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(
            f"no log folder {folder}: {error.strerror}; set ROS_LOG_DIR to one that can be written"
        ) from None
    with contextlib.suppress(OSError):  # a file system without links, or a folder of another user
        latest = parent / "latest"
        latest.unlink(missing_ok=True)
        latest.symlink_to(folder)
    return folder


class LaunchLog(LogFile):
    """roslaunch-HOST-PID.log: messages of one launch."""

    def __init__(self, folder: Path) -> None:
        path = folder / f"roslaunch-{socket.gethostname()}-{os.getpid()}.log"
        super().__init__(path, max_bytes=PYTHON_LOG_BYTES, backups=PYTHON_LOG_BACKUPS)

    def write(self, text: str) -> None:
        """Write a message with its time; links in it lose their tokens."""
        super().write(python_log_line("roslaunch", without_tokens(text)))

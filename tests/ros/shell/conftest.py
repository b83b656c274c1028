"""A user's environment for shells: a home folder, and a free port for the master."""

import os
from pathlib import Path

import pytest
from tests.graphs import free_port


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    foreign = (
        *("ROS_", "GAZEBO_", "TRUNDLE_", "CMAKE_", "PROMPT_COMMAND", "BASH_ENV"),
        *("BROWSER", "DISPLAY", "WAYLAND_DISPLAY"),  # or else a developer's browser opens
    )
    inherited = {key: value for key, value in os.environ.items() if not key.startswith(foreign)}
    return {
        **inherited,
        "HOME": str(tmp_path),
        "SHELL": "/bin/bash",
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
    }

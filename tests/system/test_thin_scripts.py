"""Scripts that import ROS only through their package, with a `python3` that is not Trundle's."""

import signal
import subprocess
import sys
from pathlib import Path


def test_scripts_that_import_only_their_packages_module_run(shared: Path, env: dict[str, str], tmp_path: Path) -> None:
    """As with trundle installed by pipx or uv."""
    case = shared / "cases/node_thin_script"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tmp_path / "venv"], check=True)
    env |= {"PATH": f"{tmp_path}/venv/bin:/usr/bin:/bin", "ROS_PACKAGE_PATH": str(case / "ws")}
    words = [sys.executable, "-m", "trundle", "launch", str(case / "a.launch"), "--headless"]
    expected = {"OBS running sibling", "OBS running /thin", "OBS running /thick"}
    lines: list[str] = []

    with subprocess.Popen(
        words, env=env, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as launch:
        assert launch.stdout is not None
        for line in launch.stdout:
            lines.append(line)
            expected -= {text for text in expected if text in line}
            if not expected or "has died" in line:
                break
        launch.send_signal(signal.SIGINT)
        lines += launch.stdout

    assert not expected, "".join(lines)

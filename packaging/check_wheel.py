"""Checks an installed Trundle from outside its checkout: the demo's world, both tutorials, the page.

    python packaging/check_wheel.py

It needs nothing but the standard library and the Trundle of this Python, and works in an empty folder of its own.
"""

import json
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import urllib.request
from http.cookiejar import CookieJar
from pathlib import Path

TIMEOUT_S = 600.0
TRUNDLE = Path(sysconfig.get_path("scripts"), "trundle.exe" if os.name == "nt" else "trundle")


def main() -> int:
    """Run all checks; the first failure ends it."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_"))}
        environment |= {"HOME": folder, "PYTHONPATH": "", "PYTHONUNBUFFERED": "1"}
        at = Path(folder)
        for check in (check_origin, check_demo, check_sdf_tutorial, check_ros_tutorial, check_picture, check_page):
            print(f"{check.__name__} …", flush=True)
            check(at, environment)
    print("all checks passed")
    return 0


def call(folder: Path, environment: dict[str, str], *command: str) -> str:
    """Run a command; return its standard output."""
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    require(done.returncode == 0, f"{' '.join(command)} ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    require("Traceback" not in done.stderr, done.stderr)
    return done.stdout


def require(holds: bool, message: str) -> None:
    """End with a message unless a condition holds."""
    if not holds:
        sys.exit(f"FAILED: {message}")


def check_origin(folder: Path, environment: dict[str, str]) -> None:
    """Trundle is that of this environment, not of a checkout."""
    file = call(folder, environment, sys.executable, "-c", "import trundle; print(trundle.__file__)").strip()
    require("site-packages" in file, f"trundle is imported from {file}")
    version = call(folder, environment, str(TRUNDLE), "--version").strip()
    require(re.fullmatch(r"trundle \d+\.\d+\.\d+\S*", version) is not None, f"--version prints {version!r}")


def check_demo(folder: Path, environment: dict[str, str]) -> None:
    """The world of `make demo` stands still for two seconds."""
    words = ("run", "rp2w_at_home.world", "--headless", "--no-ros", "--speed", "max", "--duration", "2", "--json")
    models = {model["name"]: model for model in json.loads(call(folder, environment, str(TRUNDLE), *words))["models"]}
    require("rp2w" in models, f"the demo has {sorted(models)}")
    require(abs(models["rp2w"]["pose"][2]) < 0.05, f"the robot is at {models['rp2w']['pose']}")


def check_sdf_tutorial(folder: Path, environment: dict[str, str]) -> None:
    """The robot of the Gazebo tutorial runs with its plugin and its graph."""
    words = ("run", "model://rp2w", "--headless", "--speed", "max", "--duration", "2")
    require("rp2w stands at" in call(folder, environment, str(TRUNDLE), *words), "the robot does not stand")


def check_ros_tutorial(folder: Path, environment: dict[str, str]) -> None:
    """The car of the ROS tutorial is launched, shown and simulated."""
    for file in ("display.launch", "drive.launch"):
        call(folder, environment, str(TRUNDLE), "launch", "smartcar", file, "--headless", "--duration", "3")


def check_picture(folder: Path, environment: dict[str, str]) -> None:
    """The renderer draws."""
    call(folder, environment, str(TRUNDLE), "render", "rp2w_at_home.world", "-o", "home.png")
    require((folder / "home.png").read_bytes().startswith(b"\x89PNG"), "home.png is no PNG")


def check_page(folder: Path, environment: dict[str, str]) -> None:
    """The page serves its document and its script."""
    words = ("run", "rp2w_at_home.world", "--no-browser", "--no-ros", "--port", "0")
    command = [str(TRUNDLE), *words]
    with subprocess.Popen(
        command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        assert process.stdout is not None
        try:
            lines = iter(process.stdout.readline, "")
            links = (re.search(r"see it at (http://\S+)", line) for line in lines)
            link = next((found[1] for found in links if found), "")
            require(bool(link), "no address of the page is printed")
            opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))
            with opener.open(link, timeout=TIMEOUT_S) as answer:
                base, document = answer.url, answer.read().decode()
            script = re.search(r'src="\./([^"]+\.js)"', document)
            require(script is not None, f"the page has no script:\n{document[:500]}")
            assert script is not None
            with opener.open(urllib.request.urljoin(base, script[1]), timeout=TIMEOUT_S) as answer:
                require(len(answer.read()) > 100, "the page's script is empty")
        finally:
            process.terminate()


if __name__ == "__main__":
    sys.exit(main())

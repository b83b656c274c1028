"""Launch files of public packages: mapped while driving, localized from a wrong guess, driven to two goals.

`python -m bench.public_navigation CHECKOUTS [NAME …]`: CHECKOUTS is a folder of checkouts, each named OWNER+REPOSITORY;
NAME a case of `public_navigation.yaml` (all of them). The runs are headless and flat out. The table has what was
mapped, how far amcl was wrong at first and at last, the goals reached, and what the robot touched. A goal that
move_base calls reached counts if the robot is there: it may have lost itself.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from trundle.ros import Messages, open_bag

_PLUGINS = Path(__file__).parent / "navigation_judge"
_CASES = Path(__file__).with_suffix(".yaml")
_DEFAULTS: dict[str, Any] = {
    "scan": "/scan",
    "cmd_vel": "/cmd_vel",
    "initialpose": "/initialpose",
    "move_base": "/move_base",
    "map_topic": "/map",
    "map_frame": "map",
    "base": "base_link",
    "link": "base_footprint",
    "model": "robot",
    "radius": 0.3,
    "speed": 0.3,
    "bend": 0.12,
    "creep": 0.0,
    "max_way": 8.0,
    "localized": True,
    "map_s": 60.0,
    "drive_s": 120.0,
    "tags": "",
    "map_server": False,
    "env": {},
}
"""Options of a case. `radius`: that of the robot [m]; `bend`: turn while it drives and maps [rad/s]; `map_s`,
`drive_s`: limits [s of the simulation].
`tags`: more of the launch file; `map_server`: whether the packages start none."""
_JUDGE = """<sdf version="1.6"><model name="judge"><static>1</static><pose>0 0 -50 0 0 0</pose><link name="l"/>
<plugin name="judge" filename="libjudge_navigation.so"><job>{job}</job><out>{out}</out></plugin></model></sdf>"""
_SPAWN = '<node pkg="gazebo_ros" type="spawn_model" name="judge" args="-sdf -file {file} -model judge -z -50"/>'
_RECORD = '<node pkg="rosbag" type="record" name="record_map" args="-O {bag} {topic}"/>'
_MAP_SERVER = '<node pkg="map_server" type="map_server" name="map_server" args="{map}"/>'
_TIMEOUT_S = 1500.0
_SUCCEEDED = 3
_NEAR_M = 0.5
"""Distance of the robot from a goal that it has reached."""
_LEAST_WAY_M = 2.0
"""Way to the farther goal below which a case proves nothing."""
_WORD = re.compile(r"(?:\$\([^)]*\)|\S)+")


def main(words: list[str]) -> int:
    """Run cases, and print a table."""
    checkouts, names = Path(words[0]).absolute(), words[1:]
    cases = yaml.safe_load(_CASES.read_text())
    failed = 0
    print("| package | map m² | wrong at first, at last m | goals | way, time | touched | × real time |")
    print("|---|---|---|---|---|---|---|")
    for name, case in cases.items():
        if not names or name in names:
            with tempfile.TemporaryDirectory() as folder:
                row, is_good = _run(name, {**_DEFAULTS, **case}, checkouts, Path(folder))
            failed += not is_good
            print(row, flush=True)
    return min(failed, 1)


def _run(name: str, case: dict[str, Any], checkouts: Path, folder: Path) -> tuple[str, bool]:
    stem = re.sub(r"\W+", "_", name)
    mapped = _launch(f"{stem}.map", case, checkouts, folder, case["mapping"], None)
    if mapped is None:
        return f"| {name} | no result of mapping | – | – | – | – | – |", False
    cells = _save_map(folder / f"{stem}.map.bag", case["map_topic"], folder / "map")
    if cells is None or "world_from_map" not in mapped:
        lacking = case["map_topic"] if cells is None else f"frame {case['map_frame']}"
        return f"| {name} | no {lacking} | – | – | – | – | – |", False
    if "LOGS" in os.environ:
        for kind in (".pgm", ".yaml"):
            (Path(os.environ["LOGS"]) / f"{stem}{kind}").write_bytes((folder / "map").with_suffix(kind).read_bytes())
    map_m2 = f"{np.count_nonzero(cells[0] == 0) * cells[1] ** 2:.1f}"
    job = {"map": str(folder / "map.yaml"), "world_from_map": mapped["world_from_map"]}
    driven = _launch(f"{stem}.drive", case, checkouts, folder, case["navigation"], job)
    if driven is None:
        return f"| {name} | {map_m2} | no result of navigation | – | – | – | – |", False
    reached = [goal for goal in driven["goals"] if goal.get("state") == _SUCCEEDED and goal["beside_m"] <= _NEAR_M]
    errors = ", ".join(f"{driven[key]:.2f}" if key in driven else "–" for key in ("first_error_m", "error_m"))
    times = ", ".join(f"{goal['way_m']:.1f} m {goal['seconds']:.0f} s" for goal in reached)
    hit = ", ".join(sorted(driven["collisions"])) or "nothing"
    if mapped["collisions"]:
        hit += f" (while mapping: {', '.join(sorted(mapped['collisions']))})"
    factor = f"{driven['seconds'] / driven['wall_s']:.1f}"
    row = f"| {name} | {map_m2} | {errors} | {len(reached)} of 2 | {times} | {hit} | {factor} |"
    is_near = max((goal["way_m"] for goal in reached), default=0.0) < _LEAST_WAY_M
    return row, len(reached) == len(driven["goals"]) == 2 and not driven["collisions"] and not is_near


def _launch(
    name: str, case: dict[str, Any], checkouts: Path, folder: Path, files: list[str], job: dict[str, Any] | None
) -> dict[str, Any] | None:
    """Launch a case's world and files until the judge ends it; return what the judge wrote."""
    limit_s = case["map_s"] if job is None else case["drive_s"]
    options = {"map": None, "limit_s": limit_s, **case, **(job or {})}
    job_file, out, judge = folder / f"{name}.json", folder / f"{name}.out.json", folder / f"{name}.sdf"
    job_file.write_text(json.dumps(options))
    judge.write_text(_JUDGE.format(job=job_file, out=out))
    tags = "".join(_include(words.replace("{map}", str(options["map"]))) for words in [*case["world"], *files])
    launch = folder / f"{name}.launch"
    more = case["tags"]
    if job is None:
        more += _RECORD.format(bag=folder / f"{name}.bag", topic=case["map_topic"])
    elif case["map_server"]:
        more += _MAP_SERVER.format(map=options["map"])
    launch.write_text(f"<launch>{tags}{more}{_SPAWN.format(file=judge)}</launch>")
    paths = [str(checkouts / repository) for repository in case["repositories"]]
    variables = {"ROS_PACKAGE_PATH": ":".join(paths), "TRUNDLE_PLUGIN_PATH": str(_PLUGINS), "ROS_HOME": str(folder)}
    command = [sys.executable, "-m", "trundle", "launch", str(launch), "--headless", "--speed", "max", "--port", "0"]
    command += ["--lenient", "--duration", str(limit_s + 5), "--no-summary"]
    log = Path(os.environ.get("LOGS", folder)) / f"{name}.log"
    with log.open("w") as file:
        environment = {**os.environ, **variables, **case["env"]}
        try:
            subprocess.run(command, env=environment, check=False, stdout=file, stderr=file, timeout=_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            return None
    if not out.exists():
        return None
    if "LOGS" in os.environ:
        (Path(os.environ["LOGS"]) / out.name).write_text(out.read_text())
    return json.loads(out.read_text())


def _include(words: str) -> str:
    """Return the <include> of 'PACKAGE FILE NAME:=VALUE …'."""
    package, file, *arguments = _WORD.findall(words)
    folder = "" if file.startswith("/") else "launch/"
    values = "".join(
        f'<arg name="{argument.partition(":=")[0]}" value="{argument.partition(":=")[2]}"/>' for argument in arguments
    )
    return f'<include file="$(find {package})/{folder}{file.removeprefix("/")}">{values}</include>'


def _save_map(bag: Path, topic: str, to: Path) -> tuple[NDArray[np.int8], float] | None:
    """Write a bag's last map as PGM and YAML; return its cells and resolution [m]."""
    if not bag.exists():
        return None
    messages = Messages()
    with open_bag(bag) as reader:
        found = list(reader.messages(lambda connection: connection.topic == topic))
    if not found:
        return None
    grid = messages.deserialize(found[-1].data, found[-1].connection.type)
    info = grid.info
    cells = np.array(grid.data, dtype=np.int8).reshape(info.height, info.width)
    pixels = np.full(cells.shape, 205, dtype=np.uint8)
    pixels[cells == 0], pixels[cells > 60] = 254, 0
    header = f"P5\n{info.width} {info.height}\n255\n".encode()
    to.with_suffix(".pgm").write_bytes(header + np.flipud(pixels).tobytes())
    at, turn = info.origin.position, info.origin.orientation
    yaw = 2.0 * np.arctan2(turn.z, turn.w)
    to.with_suffix(".yaml").write_text(
        f"image: {to.name}.pgm\nresolution: {info.resolution:.6f}\norigin: [{at.x}, {at.y}, {yaw}]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return cells, float(info.resolution)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""`make bench`: every benchmark in one run, as ratios against a peer of the same run.

A ratio is the median, over alternating pairs of runs, of Trundle's result over the peer's. Each row names its peer
with the peer's options. Run it on an idle machine: other programs slow down both, but not equally.

    python -m bench                 all benchmarks, more than an hour
    python -m bench step renderer   two benchmarks
"""

import argparse
import importlib
import sys
import traceback

from bench.peers import TABLE
from bench.table import Row, print_table

BENCHES = {
    "graph": "topics against rospy: messages a second, ages, start of a node",
    "roscpp": "C++ nodes against Debian's roscpp: messages a second, ages, start; compiling a node",
    "cpp_plugin": "a C++ plugin at every step of the RP2W, against the RP2W without it",
    "descriptions": "reading URDF and SDF against other readers",
    "commands": "trundle check and xacro against ROS' tools",
    "step": "stepping the RP2W against the engine's bare loop",
    "sweep": "parameter sweeps",
    "environments": "gym environments",
    "gpu": "batches on a GPU, if there is one",
    "robots": "one, ten and fifty robots",
    "growth": "hundreds of robots, thousands of boxes, a million faces",
    "hooks": "controllers and a lidar at their rates",
    "contacts": "piles, walls and contact sensors",
    "house": "a furnished house",
    "images": "image topics",
    "arm_planning": "plans of an arm in four scenes",
    "kinematics": "inverse kinematics of an arm",
    "commander": "start of a moveit_commander program",
    "navigation": "amcl and move_base in a house, twenty tours",
    "localization": "amcl in that house, from wrong guesses and from none",
    "navigation_parts": "amcl, gmapping, costmaps and planners alone",
    "renderer": "pictures and scans against MuJoCo and PyBullet",
    "dataset": "labelled pictures",
    "page_feed": "CPU time of serving pages",
    "startup": "start to first step",
    "launches": "launch files to their first message",
    "page": "CPU time of the page's server",
    "page_start": "a page's start in Chromium",
    "page_slow": "a slow page beside another one",
    "page_pointer": "pointer events in large worlds",
    "page_frames": "script time of a page with a large cloud, many topics, many models",
}
"""Module name → measurement."""


def main() -> int:
    """Run the benchmarks named on the command line, or all, and print one table; 1 if any failed."""
    names = "\n".join(f"  {name:13} {description}" for name, description in BENCHES.items())
    parser = argparse.ArgumentParser(
        prog="python -m bench",
        description=__doc__,
        epilog=f"benchmarks:\n{names}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("benchmarks", metavar="NAME", nargs="*", help="one of the list below; all by default")
    selected: list[str] = parser.parse_args().benchmarks or list(BENCHES)
    if unknown := [name for name in selected if name not in BENCHES]:
        parser.error(f"no benchmark {unknown[0]!r}; there are: {', '.join(BENCHES)}")
    rows: list[Row] = []
    failed: list[str] = []
    for name in selected:
        print(f"bench: {name} …", file=sys.stderr)
        try:
            measured = importlib.import_module(f"bench.{name}").run()
        except Exception:  # the other benchmarks continue
            traceback.print_exc()
            failed.append(name)
            continue
        if not measured:
            print(f"bench: {name}: its programs or files are not on this machine", file=sys.stderr)
        rows += measured
    print_table(rows)
    print(f"\nFor comparison, not measured in this run:{TABLE}")
    for name in failed:
        print(f"bench: {name} failed; see its traceback above", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

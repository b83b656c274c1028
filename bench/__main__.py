"""`make bench`: every benchmark in one run, as ratios against a peer of the same run.

A ratio is the median over pairs of runs, ours and the peer's in alternation, of our figure over the peer's. Each row
names its peer with the peer's options. On a quiet machine only: other programs count for both, but not alike.

    python -m bench                 all of them, about half an hour
    python -m bench step renderer   these
"""

import argparse
import importlib
import sys
import traceback

from bench.peers import TABLE
from bench.table import Row, print_table

BENCHES = {
    "graph": "topics against rospy: messages a second, ages, start of a node",
    "descriptions": "reading URDF and SDF against other readers",
    "commands": "trundle check and xacro against ROS' tools",
    "step": "stepping the RP2W against the engine's bare loop",
    "sweep": "parameter sweeps",
    "environments": "gym environments",
    "gpu": "batches on a GPU, where there is one",
    "robots": "one, ten and fifty robots",
    "growth": "hundreds of robots, thousands of boxes, a million faces",
    "hooks": "controllers and a lidar at their rates",
    "contacts": "piles, walls and contact sensors",
    "house": "a furnished house",
    "images": "image topics",
    "renderer": "pictures and scans against MuJoCo and PyBullet",
    "dataset": "labelled pictures",
    "page_feed": "what a page gets, by processor time",
    "startup": "start to first step",
    "launches": "launch files to their first message",
    "page": "a page's pace in Chromium",
    "page_start": "a page's start in Chromium",
    "page_pointer": "pointer events in large worlds",
}
"""Name of each module → what it measures."""


def main() -> int:
    """Run the benchmarks named on the command line, or all, and print one table; 1 if any failed."""
    names = "\n".join(f"  {name:13} {what}" for name, what in BENCHES.items())
    parser = argparse.ArgumentParser(
        prog="python -m bench",
        description=__doc__,
        epilog=f"benchmarks:\n{names}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("benchmarks", metavar="NAME", nargs="*", help="one of the list below; all by default")
    chosen: list[str] = parser.parse_args().benchmarks or list(BENCHES)
    if unknown := [name for name in chosen if name not in BENCHES]:
        parser.error(f"no benchmark {unknown[0]!r}; there are: {', '.join(BENCHES)}")
    rows: list[Row] = []
    failed: list[str] = []
    for name in chosen:
        print(f"bench: {name} …", file=sys.stderr)
        try:
            measured = importlib.import_module(f"bench.{name}").run()
        except Exception:  # of any kind: the others go on
            traceback.print_exc()
            failed.append(name)
            continue
        if not measured:
            print(f"bench: {name}: nothing that it measures is on this machine", file=sys.stderr)
        rows += measured
    print_table(rows)
    print(f"\nFor reading, not of this run:{TABLE}")
    for name in failed:
        print(f"bench: {name} failed: its traceback is above", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

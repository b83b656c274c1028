"""`make bench`: every benchmark in one run, as ratios against a peer of the same run."""

import importlib
import sys

from bench.peers import TABLE
from bench.table import Row, print_table

BENCHES = (
    "graph",
    "descriptions",
    "commands",
    "step",
    "sweep",
    "environments",
    "gpu",
    "robots",
    "hooks",
    "contacts",
    "house",
    "images",
    "renderer",
    "dataset",
    "page_feed",
    "startup",
    "launches",
    "page",
    "page_start",
    "page_pointer",
)


def main() -> int:
    """Run the benchmarks named on the command line, or all, and print one table."""
    chosen = sys.argv[1:] or BENCHES
    rows: list[Row] = []
    for name in chosen:
        if name not in BENCHES:
            print(f"bench: no benchmark {name!r}; there are: {', '.join(BENCHES)}", file=sys.stderr)
            return 2
        print(f"bench: {name} …", file=sys.stderr)
        rows += importlib.import_module(f"bench.{name}").run()
    print_table(rows)
    print(f"\nFor reading, not of this run:{TABLE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

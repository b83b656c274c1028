"""`make fuzz`: mutated inputs for every file format that Trundle reads and every socket.

A finding is an error that is no TrundleError, a printed traceback or warning, a report of a sanitizer, a crash,
a hang, more than 10 s of CPU time or 1 GB of memory for one input. out/fuzz/findings has a folder for each kind with
the shortest input, and report.txt with a command that repeats it. out/fuzz/summary.json has hours, executions and
findings of each target over all runs; out/fuzz/corpus has inputs that reached new code, where later runs continue.
"""

import argparse
import os
import sys
from pathlib import Path

from . import atheris_engine, sanitized
from .campaign import Campaign
from .catalog import NATIVE, TARGETS
from .target import ROOT

_SECONDS = 600.0


def main() -> int:
    """Fuzz; return 1 if there are findings."""
    formatter = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(prog="python -m fuzz", description=__doc__, formatter_class=formatter)
    parser.add_argument("targets", metavar="TARGET", nargs="*", help=f"all by default: {' '.join(TARGETS)}")
    parser.add_argument("--seconds", type=float, default=_SECONDS, help="duration of the whole run (600)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="parallel targets (one per CPU core)")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "fuzz", help="folder of all files (out/fuzz)")
    parser.add_argument("--input", type=Path, help="feed this file to TARGET once, and print the result")
    args = parser.parse_args()
    names: list[str] = args.targets or list(TARGETS)
    if unknown := [name for name in names if name not in TARGETS]:
        parser.error(f"no target {unknown[0]!r}; there are: {' '.join(TARGETS)}")
    if args.input is not None and len(names) != 1:
        parser.error("--input needs one TARGET")
    if not atheris_engine.is_installed():
        print("fuzz: Atheris is not installed: inputs are not guided by coverage", file=sys.stderr)
    libraries = sanitized.build() if not NATIVE.isdisjoint(names) else None
    with Campaign(args.out.absolute(), libraries, {} if libraries is None else sanitized.environment()) as campaign:
        if args.input is not None:
            return campaign.repeat(names[0], args.input.absolute())
        campaign.run(names, args.seconds, args.jobs)
    for name in sorted(campaign.found):
        print((args.out / "findings" / name / "report.txt").read_text(errors="replace").split("\n\n")[0])
    print(f"fuzz: {len(campaign.found)} findings in {args.out / 'findings'}; statistics in {args.out / 'summary.json'}")
    return 1 if campaign.found else 0


if __name__ == "__main__":
    sys.exit(main())

"""List what this machine has and lacks for simulation and ROS, and the consequences."""

import argparse
import json
import os
from pathlib import Path

from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle doctor
  trundle doctor --json                               for scripts
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def main(args: argparse.Namespace) -> int:
    """Print the checks; 1 if something does not work."""
    with quiet_imports():
        from trundle.app.doctor.check import table
        from trundle.app.doctor.examination import examine

    checks = examine(os.environ, Path.cwd())
    print(json.dumps({"checks": [check.as_json() for check in checks]}) if args.json else table(checks))
    return 1 if any(check.state == "problem" for check in checks) else 0

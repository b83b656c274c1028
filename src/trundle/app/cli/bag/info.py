"""`trundle bag info`: summary of a bag in rosbag's format."""

import argparse
import re
import sys
from pathlib import Path
from typing import Any, cast

from trundle.ros import BagSummary, open_bag

_KEY = re.compile(r"(\w+)|\[(-?\d+)\]")


def main(args: argparse.Namespace) -> int:
    """Print the summary of each bag."""
    if args.key and not args.yaml:
        return args.refuse("You can only specify key when printing in YAML format.")
    for i, name in enumerate(args.bags):
        if i:
            print("---")
        with open_bag(Path(name)) as bag:
            summary = BagSummary(bag, name, with_rates=args.freq)
            if args.key:
                _print_value(summary.yaml(), args.key)
            else:
                print(summary.yaml() if args.yaml else summary.text())
    return 0


def _print_value(text: str, key: str) -> None:
    """Print a YAML value such as `duration` or `topics[0].type`, as rosbag does; a missing key is no failure."""
    import yaml

    value: Any = yaml.safe_load(text)
    try:
        for name, index in _KEY.findall(key):
            value = value[name] if name else value[int(index)]
    except (KeyError, IndexError, TypeError):
        print(f'Error getting key "{key}"', file=sys.stderr)
        return
    if isinstance(value, list):
        print("".join(f"- {_members(item, indent='  ')}\n" for item in cast("list[object]", value)))
    else:
        print(_members(value, indent=""))


def _members(value: object, *, indent: str) -> str:
    if not isinstance(value, dict):
        return str(value)
    return f"\n{indent}".join(f"{key}: {member}" for key, member in cast("dict[str, object]", value).items())

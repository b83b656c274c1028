"""Explain a finding by its ID: what it means, an example that causes it, what to do."""

import argparse

EXAMPLES = """
  trundle explain                                     all IDs, a sentence each
  trundle explain impossible-inertia                  one of them in full
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("id", nargs="?", metavar="ID", help="the word in brackets at the end of a finding")


def main(args: argparse.Namespace) -> int:
    """Print the entry of an ID, or the list of all."""
    from trundle.base.explanations import explain, explanations

    if args.id is not None:
        print(explain(args.id.strip("[]")).text())
        return 0
    entries = explanations().values()
    width = max(len(entry.id) for entry in entries)
    for section in dict.fromkeys(entry.section for entry in entries):
        print(f"{section}:")
        for entry in entries:
            if entry.section == section:
                print(f"  {entry.id:<{width}}  {entry.summary()}")
    return 0

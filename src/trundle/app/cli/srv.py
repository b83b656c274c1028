"""Show service types, as rossrv does."""

import argparse

from . import definitions

EXAMPLES = """
  trundle srv show std_srvs/SetBool
  trundle srv show Empty
  trundle srv info std_srvs/SetBool
  trundle srv list
  trundle srv md5 std_srvs/SetBool
  trundle srv package std_srvs
  trundle srv packages
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    definitions.configure(parser, "service")


def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return definitions.run(args, "service")

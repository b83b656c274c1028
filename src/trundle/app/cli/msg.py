"""Show message types, as rosmsg does."""

import argparse

from . import definitions

EXAMPLES = """
  trundle msg show geometry_msgs/Twist
  trundle msg show String
  trundle msg info geometry_msgs/Twist
  trundle msg list
  trundle msg md5 geometry_msgs/Twist
  trundle msg package geometry_msgs
  trundle msg packages
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    definitions.configure(parser, "message")


def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return definitions.run(args, "message")

"""Open a shell with Trundle's commands under the names of ROS 1 and Gazebo."""

import argparse
import os

from .originals import FUNCTIONS, ORIGINALS

EXAMPLES = """
  trundle shell                                       the user's shell; exit leaves it, and nothing stays behind
  trundle shell -c 'roslaunch my_robot drive.launch'  one command in it
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-c", dest="command", metavar="COMMAND", help="run it in the shell, and exit with its code")
    parser.add_argument("--list", action="store_true", help="print the names of the commands")


def main(args: argparse.Namespace) -> int:
    """Run the shell to its end."""
    if args.list:
        print("\n".join(sorted(ORIGINALS)))
        return 0
    from trundle.ros.rospy.environment import SITE, python_libraries
    from trundle.ros.sdk import GAZEBO_CMAKE
    from trundle.ros.shell import run_shell

    return run_shell(
        ORIGINALS,
        functions=FUNCTIONS,
        python_path=SITE,
        libraries=python_libraries(),
        gazebo=GAZEBO_CMAKE,
        command=args.command,
        environment=os.environ,
    )

"""Print shell code that makes the commands of ROS 1 and Gazebo available."""

import argparse
import shlex
import sys

from .originals import FUNCTIONS, ORIGINALS

EXAMPLES = """
  eval "$(trundle activate)"                          in bash, zsh and sh; trundle_deactivate undoes it
  trundle activate --shell fish | source              in fish
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("--shell", choices=("bash", "zsh", "sh", "fish"), default="bash", help="shell to print for")


def main(args: argparse.Namespace) -> int:
    """Print the code; on a terminal, only how to use it."""
    if sys.stdout.isatty():
        print('eval "$(trundle activate)" makes the commands available in this shell')
        return 0
    from trundle.ros.rospy.environment import SITE, python_libraries
    from trundle.ros.sdk import GAZEBO_CMAKE
    from trundle.ros.shell import write_activation

    folder = write_activation(
        ORIGINALS, functions=FUNCTIONS, python_path=SITE, libraries=python_libraries(), gazebo=GAZEBO_CMAKE
    )
    if args.shell == "fish":
        print(f"source {shlex.quote(str(folder / 'activate.fish'))}")
        return 0
    print(f". {shlex.quote(str(folder / 'activate.sh'))}")
    print(_AT_EXIT)
    return 0


_AT_EXIT = """\
if [ -n "${ZSH_VERSION-}" ]; then
  autoload -Uz add-zsh-hook && add-zsh-hook zshexit trundle_deactivate
elif [ -n "${BASH_VERSION-}" ] && [ -z "$(trap -p EXIT)" ]; then
  trap trundle_deactivate EXIT
fi"""
"""Code that removes the folder of commands when the shell ends."""

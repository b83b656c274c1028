"""Start a ROS 1 launch file."""

import argparse

from .main import quiet_imports

EXAMPLES = """
  trundle launch smartcar_description smartcar_display.rviz.launch
                                                      a package on ROS_PACKAGE_PATH and a file in it
  trundle launch robot.launch gui:=false              a file, with an argument
  trundle launch robot.launch --headless --duration 20
                                                      no browser page, end after 20 s of ROS time
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("words", nargs="+", metavar="[PKG] FILE [ARG:=VALUE]", help="what to launch, and its arguments")
    parser.add_argument("--headless", action="store_true", help="no browser page; rviz idles")
    parser.add_argument("--duration", type=float, metavar="S", help="end after so many seconds of ROS time")
    parser.add_argument("-p", "--port", type=int, metavar="N", help="the master's port (that of ROS_MASTER_URI, 11311)")
    parser.add_argument("--view-port", type=int, metavar="N", help="the page's port (8080, or the next free one)")
    parser.add_argument("--host", default="127.0.0.1", help="address that everything binds (127.0.0.1)")
    parser.add_argument("--screen", action="store_true", help="show the output of every node")
    parser.add_argument("--nodes", action="store_true", help="list the nodes and end")
    parser.add_argument("--ros-args", action="store_true", help="list the file's arguments and end")
    parser.add_argument("--dump-params", action="store_true", help="print the parameters as YAML and end")
    parser.add_argument("--strict", action="store_true", help="a warning about the file is an error")


def main(args: argparse.Namespace) -> int:
    """Launch until the duration is over, a required node dies, or Ctrl-C."""
    with quiet_imports():
        from trundle.bringup import LaunchOptions, launch

    options = LaunchOptions(
        headless=args.headless,
        duration_s=args.duration,
        master_port=args.port,
        view_port=args.view_port,
        host=args.host,
        screen=args.screen,
        strict=args.strict,
        only="nodes" if args.nodes else "arguments" if args.ros_args else "params" if args.dump_params else None,
    )
    return launch(args.words, options)

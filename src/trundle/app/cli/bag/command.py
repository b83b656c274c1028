"""Record, play, describe and edit bags, as rosbag does."""

import argparse
import math
from collections.abc import Callable
from importlib import import_module
from typing import Any

from ..graph_command import IntermixedParser, ros_errors

EXAMPLES = """
  trundle bag record -O drive.bag /odom /tf /scan
  trundle bag record -a -O drive.mcap
  trundle bag play drive.bag --clock -r 2
  trundle bag info drive.bag
  trundle bag check old.bag -g rules.bmr
  trundle bag filter drive.bag odom.bag "topic == '/odom'"
  trundle bag compress --lz4 drive.bag
  trundle bag decompress drive.bag
  trundle bag fix old.bag new.bag rules.bmr
  trundle bag reindex drive.bag.active
"""
_RULES: dict[str, Any] = {
    "description": "Rule files are Python programs: the given ones are run, and, without -n, also those\n"
    "that packages on the package path export as <rosbag migration_rule_file=…/>; their paths\n"
    "are printed."
}


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=IntermixedParser)
    _configure_record(commands.add_parser("record", help="record topics in a bag"))
    _configure_play(commands.add_parser("play", help="publish the messages of bags"))
    add = commands.add_parser("info", help="summarize bags")
    add.add_argument("bags", nargs="+", help="bag files")
    add.add_argument("-y", "--yaml", action="store_true", help="as YAML")
    add.add_argument("-k", "--key", help="only this key of the YAML")
    add.add_argument("--freq", action="store_true", help="with the median frequency of each topic")
    add.set_defaults(run=_import_on_use("info", "main"), refuse=add.error)
    _configure_check(commands.add_parser("check", help="compare the types in a bag with the known ones", **_RULES))
    add = commands.add_parser("filter", help="copy the messages for which an expression is true")
    add.add_argument("inbag", help="bag file to read")
    add.add_argument("outbag", help="bag file to write")
    add.add_argument("expression", help="Python expression of topic, m (the message) and t (its time)")
    add.add_argument("-p", "--print", metavar="EXPR", help="Python expression to print for each message")
    add.set_defaults(run=_import_on_use("edit", "filter_bag"))
    for name, help_ in (("compress", "compress bags"), ("decompress", "decompress bags")):
        add = commands.add_parser(name, help=help_)
        _configure_edit(add)
        if name == "compress":
            _configure_compression(add)
        add.set_defaults(run=_import_on_use("edit", name))
    _configure_fix(commands.add_parser("fix", help="migrate messages to the known types", **_RULES))
    for name in ("encrypt", "decrypt"):
        add = commands.add_parser(name, help="not supported; prints alternatives")
        _configure_edit(add)
        _configure_compression(add)
        add.add_argument("-p", "--plugin", help=argparse.SUPPRESS)
        add.add_argument("-r", "--param", help=argparse.SUPPRESS)
        add.set_defaults(run=_import_on_use("fix", "encrypt"))
    add = commands.add_parser("reindex", help="recover bags whose recording was cut off")
    _configure_edit(add)
    add.set_defaults(run=_import_on_use("edit", "reindex"))


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _configure_record(add: argparse.ArgumentParser) -> None:
    add.add_argument("topics", nargs="*", help="names; or regular expressions with -e")
    add.add_argument("-a", "--all", action="store_true", help="all topics")
    add.add_argument("-e", "--regex", action="store_true", help="topics are regular expressions")
    add.add_argument("-x", "--exclude", default="", metavar="REGEX", help="topics to exclude from -a or -e")
    add.add_argument("--node", help="topics this node subscribes to")
    name = add.add_mutually_exclusive_group()
    name.add_argument("-o", "--output-prefix", metavar="PREFIX", help="prefix of a file name with the date")
    name.add_argument("-O", "--output-name", metavar="NAME", help="file name; .mcap selects MCAP")
    add.add_argument("-q", "--quiet", action="store_true", help="print nothing")
    add.add_argument("-l", "--limit", type=int, default=0, metavar="NUM", help="messages per topic")
    add.add_argument("--split", action="store_true", help="start a new file at --size or --duration")
    add.add_argument("--max-splits", type=int, default=0, metavar="N", help="keep the newest N files")
    add.add_argument("--size", type=int, default=0, metavar="MB", help="maximum file size")
    add.add_argument("--duration", type=_duration, default=0, metavar="TIME", help="maximum duration: 30, 5m or 2h")
    add.add_argument("-b", "--buffsize", type=int, default=256, metavar="MB", help="queue size; 0: no limit")
    add.add_argument("--chunksize", type=int, default=768, metavar="KB", help="chunk size")
    add.add_argument("--tcpnodelay", action="store_true", help="request TCP_NODELAY from publishers")
    add.add_argument("-p", "--publish", action="store_true", help="publish the file's name on begin_write")
    add.add_argument("--repeat-latched", action="store_true", help="repeat latched messages in each new file")
    add.add_argument("--udp", action="store_true", help=argparse.SUPPRESS)
    _configure_compression(add)
    add.add_argument("--zstd", dest="compression", action="store_const", const="zstd", help="zstd compression (MCAP)")
    add.set_defaults(run=_import_on_use("record", "main"), refuse=add.error, compression="none")


def _configure_play(add: argparse.ArgumentParser) -> None:
    add.add_argument("bags", nargs="*", metavar="bag", help="bag files")
    add.add_argument("--bags", dest="more_bags", nargs="+", default=[], metavar="BAG", help="bags, after --topics")
    add.add_argument("-p", "--prefix", default="", help="prefix of every topic")
    add.add_argument("-q", "--quiet", action="store_true", help="print nothing")
    add.add_argument("-i", "--immediate", action="store_true", help="do not wait between messages")
    add.add_argument("--pause", action="store_true", help="start paused")
    add.add_argument("--queue", type=int, default=100, metavar="SIZE", help="queue size per publisher")
    add.add_argument("--clock", action="store_true", help="publish /clock")
    add.add_argument("--hz", type=_positive, default=100.0, help="rate of /clock (100)")
    add.add_argument("-d", "--delay", type=float, default=0.2, metavar="SEC", help="wait after advertising")
    add.add_argument("-r", "--rate", type=_positive, default=1.0, metavar="FACTOR", help="playback rate (1)")
    add.add_argument("-s", "--start", type=float, default=0.0, metavar="SEC", help="offset into the bags")
    add.add_argument("-u", "--duration", type=float, metavar="SEC", help="duration to play")
    add.add_argument("--skip-empty", type=float, metavar="SEC", help="skip longer silences")
    add.add_argument("-l", "--loop", action="store_true", help="repeat forever")
    add.add_argument("-k", "--keep-alive", action="store_true", help="keep running at the end, for latched topics")
    add.add_argument("--topics", nargs="+", default=[], help="only these topics")
    add.add_argument("--pause-topics", nargs="+", default=[], help="pause before messages of these topics")
    add.add_argument("--wait-for-subscribers", action="store_true", help="wait until every topic has a subscriber")
    add.add_argument("--try-future-version", action="store_true", help="no effect: 2.0 is the last version")
    add.add_argument("--rate-control-topic", metavar="TOPIC", help="wait for the stamps of this topic's headers")
    add.add_argument("--rate-control-max-delay", type=_positive, default=1.0, metavar="SEC", help="maximum lag (1)")
    add.set_defaults(run=_import_on_use("play", "main"), refuse=add.error)


def _configure_check(add: argparse.ArgumentParser) -> None:
    add.add_argument("bag", help="bag file")
    _configure_rules(add)
    add.add_argument("-g", "--genrules", metavar="RULES", help="write the missing rules to a file, to be completed")
    add.add_argument("-a", "--append", action="store_true", help="use the rules in that file, and append to it")
    add.set_defaults(run=_import_on_use("check", "main"), refuse=add.error)


def _configure_fix(add: argparse.ArgumentParser) -> None:
    add.add_argument("inbag", help="bag file to read")
    add.add_argument("outbag", help="bag file to write")
    _configure_rules(add)
    add.add_argument("--force", action="store_true", help="apply incomplete rules: new fields stay 0")
    add.set_defaults(run=_import_on_use("fix", "main"), refuse=add.error)


def _configure_rules(add: argparse.ArgumentParser) -> None:
    add.add_argument("rules", nargs="*", metavar="RULES", help="rule files (.bmr) to run")
    add.add_argument("-n", "--noplugins", action="store_true", help="ignore rules exported by packages")


def _configure_edit(add: argparse.ArgumentParser) -> None:
    add.add_argument("bags", nargs="+", metavar="bag", help="bag files")
    add.add_argument("--output-dir", metavar="DIR", help="output folder (in place, keeping the old bag as .orig)")
    add.add_argument("-f", "--force", action="store_true", help="overwrite an existing .orig")
    add.add_argument("-q", "--quiet", action="store_true", help="print errors only")


def _configure_compression(add: argparse.ArgumentParser) -> None:
    add.add_argument("-j", "--bz2", dest="compression", action="store_const", const="bz2", help="BZ2 compression")
    add.add_argument("--lz4", dest="compression", action="store_const", const="lz4", help="LZ4 compression")
    add.set_defaults(compression="bz2")


def _duration(text: str) -> float:
    """Convert `30`, `5m` or `2h` to seconds."""
    factor = {"s": 1.0, "m": 60.0, "h": 3600.0}.get(text[-1:])
    return _positive(text[:-1] if factor else text) * (factor or 1.0)


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not (value > 0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"a number greater than zero is needed, got {text!r}")
    return value


def _import_on_use(module: str, name: str) -> Callable[[argparse.Namespace], int]:
    """Return a command function that imports its module when called."""

    def run(args: argparse.Namespace) -> int:
        return getattr(import_module(f".{module}", __package__), name)(args)

    return run

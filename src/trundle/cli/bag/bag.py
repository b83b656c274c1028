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
  trundle bag info drive.bag
  trundle bag play drive.bag --clock -r 2
  trundle bag filter drive.bag odom.bag "topic == '/odom'"
  trundle bag reindex drive.bag.active
  trundle bag check old.bag -g rules.bmr
  trundle bag fix old.bag new.bag rules.bmr
"""
_RULES: dict[str, Any] = {
    "description": "A rule file is a Python program: what is named here is run, and so are, unless -n is given, the "
    "files that packages on your path export as <rosbag migration_rule_file=…/>; these are named as they are used."
}


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=IntermixedParser)
    _configure_record(commands.add_parser("record", help="write the messages of topics into a bag"))
    _configure_play(commands.add_parser("play", help="publish what bags hold"))
    add = commands.add_parser("info", help="summarize bags")
    add.add_argument("bags", nargs="+")
    add.add_argument("-y", "--yaml", action="store_true", help="as YAML")
    add.add_argument("-k", "--key", help="only this key of the YAML")
    add.add_argument("--freq", action="store_true", help="with the median frequency of each topic")
    add.set_defaults(run=_import_on_use("info", "main"), refuse=add.error)
    _configure_check(commands.add_parser("check", help="compare the types in a bag with those known here", **_RULES))
    add = commands.add_parser("filter", help="copy the messages for which an expression is true")
    add.add_argument("inbag")
    add.add_argument("outbag")
    add.add_argument("expression", help="Python of topic, m (the message) and t (its time)")
    add.add_argument("-p", "--print", metavar="EXPR", help="print this Python for each message")
    add.set_defaults(run=_import_on_use("edit", "filter_bag"))
    for name, help_ in (("compress", "compress bags"), ("decompress", "decompress bags")):
        add = commands.add_parser(name, help=help_)
        _configure_edit(add)
        if name == "compress":
            _configure_compression(add)
        add.set_defaults(run=_import_on_use("edit", name))
    _configure_fix(commands.add_parser("fix", help="bring messages up to the types known here", **_RULES))
    for name in ("encrypt", "decrypt"):
        add = commands.add_parser(name, help="refused: says what to use instead")
        _configure_edit(add)
        _configure_compression(add)
        add.add_argument("-p", "--plugin", help=argparse.SUPPRESS)
        add.add_argument("-r", "--param", help=argparse.SUPPRESS)
        add.set_defaults(run=_import_on_use("fix", "encrypt"))
    add = commands.add_parser("reindex", help="make bags readable whose recording was cut off")
    _configure_edit(add)
    add.set_defaults(run=_import_on_use("edit", "reindex"))


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _configure_record(add: argparse.ArgumentParser) -> None:
    add.add_argument("topics", nargs="*", help="names; or regular expressions with -e")
    add.add_argument("-a", "--all", action="store_true", help="every topic")
    add.add_argument("-e", "--regex", action="store_true", help="topics are regular expressions")
    add.add_argument("-x", "--exclude", default="", metavar="REGEX", help="topics to leave out of -a or -e")
    add.add_argument("--node", help="whatever this node subscribes to")
    name = add.add_mutually_exclusive_group()
    name.add_argument("-o", "--output-prefix", metavar="PREFIX", help="the name begins so and ends with the date")
    name.add_argument("-O", "--output-name", metavar="NAME", help="name of the file; one that ends in .mcap is MCAP")
    add.add_argument("-q", "--quiet", action="store_true", help="say nothing")
    add.add_argument("-l", "--limit", type=int, default=0, metavar="NUM", help="so many messages of each topic")
    add.add_argument("--split", action="store_true", help="begin a new file at --size or --duration")
    add.add_argument("--max-splits", type=int, default=0, metavar="N", help="keep the newest N files")
    add.add_argument("--size", type=int, default=0, metavar="MB", help="largest file")
    add.add_argument("--duration", type=_duration, default=0, metavar="TIME", help="longest file: 30, 5m or 2h")
    add.add_argument("-b", "--buffsize", type=int, default=256, metavar="MB", help="messages waiting; 0: no limit")
    add.add_argument("--chunksize", type=int, default=768, metavar="KB", help="how much is compressed at once")
    add.add_argument("--tcpnodelay", action="store_true", help="ask publishers for small delays")
    add.add_argument("-p", "--publish", action="store_true", help="tell the file's name on begin_write")
    add.add_argument("--repeat-latched", action="store_true", help="latched messages again in each new file")
    add.add_argument("--udp", action="store_true", help=argparse.SUPPRESS)
    _configure_compression(add)
    add.add_argument("--zstd", dest="compression", action="store_const", const="zstd", help="zstd compression (MCAP)")
    add.set_defaults(run=_import_on_use("record", "main"), refuse=add.error, compression="none")


def _configure_play(add: argparse.ArgumentParser) -> None:
    add.add_argument("bags", nargs="*", metavar="bag")
    add.add_argument("--bags", dest="more_bags", nargs="+", default=[], metavar="BAG", help="bags, after --topics")
    add.add_argument("-p", "--prefix", default="", help="put this before every topic")
    add.add_argument("-q", "--quiet", action="store_true", help="say nothing")
    add.add_argument("-i", "--immediate", action="store_true", help="without waiting between messages")
    add.add_argument("--pause", action="store_true", help="start paused")
    add.add_argument("--queue", type=int, default=100, metavar="SIZE", help="messages waiting for a slow subscriber")
    add.add_argument("--clock", action="store_true", help="publish /clock")
    add.add_argument("--hz", type=_positive, default=100.0, help="how often")
    add.add_argument("-d", "--delay", type=float, default=0.2, metavar="SEC", help="wait after advertising")
    add.add_argument("-r", "--rate", type=_positive, default=1.0, metavar="FACTOR", help="so much faster")
    add.add_argument("-s", "--start", type=float, default=0.0, metavar="SEC", help="start so far into the bags")
    add.add_argument("-u", "--duration", type=float, metavar="SEC", help="play only so long")
    add.add_argument("--skip-empty", type=float, metavar="SEC", help="skip longer silences")
    add.add_argument("-l", "--loop", action="store_true", help="again and again")
    add.add_argument("-k", "--keep-alive", action="store_true", help="stay at the end, for latched topics")
    add.add_argument("--topics", nargs="+", default=[], help="only these topics")
    add.add_argument("--pause-topics", nargs="+", default=[], help="pause before messages of these topics")
    add.add_argument("--wait-for-subscribers", action="store_true", help="wait until every topic has one")
    add.add_argument("--try-future-version", action="store_true", help="as always here: 2.0 is the last there will be")
    add.add_argument("--rate-control-topic", metavar="TOPIC", help="wait for the stamps of this topic's headers")
    add.add_argument("--rate-control-max-delay", type=_positive, default=1.0, metavar="SEC", help="they may be behind")
    add.set_defaults(run=_import_on_use("play", "main"), refuse=add.error)


def _configure_check(add: argparse.ArgumentParser) -> None:
    add.add_argument("bag")
    _configure_rules(add)
    add.add_argument("-g", "--genrules", metavar="RULES", help="write the rules that are missing, to be completed")
    add.add_argument("-a", "--append", action="store_true", help="use the rules in that file, and add to them")
    add.set_defaults(run=_import_on_use("check", "main"), refuse=add.error)


def _configure_fix(add: argparse.ArgumentParser) -> None:
    add.add_argument("inbag")
    add.add_argument("outbag")
    _configure_rules(add)
    add.add_argument("--force", action="store_true", help="leave fields that are new at 0 and lose those that are gone")
    add.set_defaults(run=_import_on_use("fix", "main"), refuse=add.error)


def _configure_rules(add: argparse.ArgumentParser) -> None:
    add.add_argument("rules", nargs="*", metavar="RULES", help="rule files (.bmr), which are run")
    add.add_argument("-n", "--noplugins", action="store_true", help="leave out the rules that packages export")


def _configure_edit(add: argparse.ArgumentParser) -> None:
    add.add_argument("bags", nargs="+", metavar="bag")
    add.add_argument("--output-dir", metavar="DIR", help="write there; else beside, and the old one becomes .orig")
    add.add_argument("-f", "--force", action="store_true", help="overwrite an .orig that is there")
    add.add_argument("-q", "--quiet", action="store_true", help="say only what went wrong")


def _configure_compression(add: argparse.ArgumentParser) -> None:
    add.add_argument("-j", "--bz2", dest="compression", action="store_const", const="bz2", help="BZ2 compression")
    add.add_argument("--lz4", dest="compression", action="store_const", const="lz4", help="LZ4 compression")
    add.set_defaults(compression="bz2")


def _duration(text: str) -> float:
    """`30`, `5m`, `2h` in seconds."""
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
    """The function that does the work, from a module that is imported when it runs."""

    def run(args: argparse.Namespace) -> int:
        return getattr(import_module(f".{module}", __package__), name)(args)

    return run

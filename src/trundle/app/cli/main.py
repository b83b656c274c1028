"""Finds the command, parses its arguments, and turns errors into a message and an exit code.

A command is a module or a package of this folder: the first line of its docstring is its help, `EXAMPLES` opens
`--help`, `configure(parser)` declares the arguments and `main(args)` does the work and returns the exit code.
`trundle --as rostopic …` runs a command under the name that it has in ROS, as `trundle shell` does.
"""

import argparse
import ast
import errno
import importlib
import os
import sys
from collections.abc import Callable, Sequence
from io import TextIOWrapper
from pathlib import Path
from typing import Protocol, cast

from trundle import __version__
from trundle.base.diagnostics import TrundleError, colored, nearest
from trundle.base.shortage import shortage
from trundle.robots.names import Arguments, parse_arguments

from .help_text import HelpFormatter, describe
from .originals import ORIGINALS
from .originals.original_help import EXIT_CODES, print_original_help
from .quiet_imports import quiet_imports

COMMANDS: dict[str, str] = {
    "run": "simulate a robot or a world",
    "launch": "start a ROS 1 launch file",
    "test": "run the tests of launch files, as rostest does, or every run of a sweep's plan",
    "play": "show a recorded run or a bag in the browser",
    "compare": "list the differences of two recorded runs",
    "view": "show a running ROS graph in the browser, as rviz does",
    "page": "print the links of the pages that run",
    "check": "list errors and unsupported elements of a file",
    "explain": "explain a finding by its ID, with an example and what to do",
    "convert": "convert a robot or world to SDF, URDF, MJCF or GLB, a recorded run to HTML",
    "render": "render an image or a video of a robot or a world",
    "sweep": "run a world or a launch file many times with different values",
    "dataset": "make annotated pictures of a varied world, to train vision on",
    "xacro": "expand a xacro file",
    "core": "run the ROS master, parameter server and rosout",
    "topic": "list, print, measure and publish topics",
    "node": "list, describe and ping nodes",
    "param": "read and write parameters",
    "service": "list, describe and call services",
    "bag": "record, play, describe and edit bags",
    "msg": "show message types",
    "srv": "show service types",
    "tf": "print, draw and measure transforms",
    "graph": "draw who publishes what to whom",
    "plot": "draw numbers of messages over time",
    "log": "show what nodes log",
    "exec": "run a node of a package",
    "pack": "find packages and what they need",
    "shell": "open a shell with the commands of ROS 1 and Gazebo: roslaunch, rostopic, gazebo, …",
    "activate": "print what makes them available in this shell",
    "doctor": "list what this machine has and lacks, and what that costs",
    "new": "write a package, robot, world, plugin, node, launch file or message that runs at once",
}
"""Command → one line of help; in the order of `trundle --help`."""

REMAPPED = ("bag", "service", "tf", "topic")
"""Commands that take `a:=b` and `__name:=n` anywhere, as rosbag, rosservice, rostopic and tf in launch files."""
_ROS_COMMANDS = ("core", "topic", "node", "param", "service", "bag", "msg", "srv", "tf", "plot", "log", "exec")
"""Commands that exit with 0 on Ctrl-C, as their originals do."""
_INTERMIXED = (
    "launch",
    "test",
    "sweep",
    "xacro",
    "originals.catkin_create_pkg",
    "originals.rosdep",
    "originals.wstool",
)
"""Commands with options between arguments, as in roslaunch: `trundle launch robot.launch --headless gui:=false`."""
_DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""Error numbers of writes to an open file."""
EXIT_OK, EXIT_INPUT, EXIT_USAGE, EXIT_INTERRUPTED = 0, 1, 2, 130


class CommandModule(Protocol):
    """Interface of a command's module."""

    __file__: str
    EXAMPLES: str
    configure: Callable[[argparse.ArgumentParser], None]
    main: Callable[[argparse.Namespace], int]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code: 0 success, 1 bad input, 2 wrong usage, 130 (ROS tools 0) on Ctrl-C."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    _set_error_handler(as_xml=arguments[:1] in (["convert"], ["xacro"]))
    try:
        return _main(arguments)
    except KeyboardInterrupt:
        return EXIT_OK if arguments and arguments[0] in _ROS_COMMANDS else EXIT_INTERRUPTED
    except Exception as error:
        if (reason := shortage(error)) is None:
            raise
        print(f"trundle: error: {reason}", file=sys.stderr)
        return EXIT_INPUT


def run_command(command: Sequence[str], arguments: Sequence[str]) -> int:
    """Run another command in this process; remapping arguments are passed only to commands that support them."""
    words = arguments if command[0] in REMAPPED else parse_arguments(arguments).rest
    return main([*command, *words])


def _main(arguments: list[str]) -> int:
    if arguments[:1] == ["--as"]:
        return _run_original(arguments[1:])
    if "_ARGCOMPLETE" in os.environ:
        _complete()
    if not arguments or arguments[0] in ("-h", "--help", "help"):
        print(_overview())
        return EXIT_OK if arguments else EXIT_USAGE
    if arguments[0] == "--version":
        print(f"trundle {__version__}")
        return EXIT_OK
    name = arguments[0]
    if name not in COMMANDS:
        suggestion = nearest(name, COMMANDS)
        hint = f"; did you mean {suggestion!r}?" if suggestion else "."
        print(f"trundle: no command {name!r}{hint} Commands: {', '.join(COMMANDS)}", file=sys.stderr)
        return EXIT_USAGE
    return _run(name, arguments[1:], program=f"trundle {name}")


def _run_original(arguments: Sequence[str]) -> int:
    """Run a command under its name in ROS or Gazebo; returns 0 after Ctrl-C, as the originals do."""
    if not arguments or arguments[0] not in ORIGINALS:
        print(f"trundle --as: expected one of {', '.join(ORIGINALS)}", file=sys.stderr)
        return EXIT_USAGE
    program = arguments[0]
    name, *words = ORIGINALS[program]
    if "_ARGCOMPLETE" in os.environ:
        _complete_original(program)
    if name == "exec" and words and arguments[1:2] in (["-h"], ["--help"]):  # `exec` would pass --help on to the node
        print(f"usage: {program} [ARGUMENTS]\n\nexamples:\n  {program}\n\nOpen {program}'s panel of the page.")
        return EXIT_OK
    if program in EXIT_CODES:
        code = print_original_help(program, arguments[1:], make_parser(name, program=program))
        if code is not None:
            return code
    try:
        is_subcommand = words and not name.startswith("originals.")
        code = _run(name, [*words, *arguments[1:]], program=f"trundle {name}" if is_subcommand else program)
    except KeyboardInterrupt:
        return EXIT_OK
    return EXIT_OK if code == EXIT_INTERRUPTED else code


def _run(name: str, arguments: Sequence[str], *, program: str) -> int:
    """Run a command's module.

    Args:
        name: name of its module.
        arguments: arguments after its name.
        program: program's name in messages.
    """
    parser = make_parser(name, program=program)
    try:
        words = parse_arguments(arguments) if name in REMAPPED else Arguments(rest=tuple(arguments))
        _apply_remap_arguments(words)
        parse = parser.parse_intermixed_args if name in _INTERMIXED else parser.parse_args
        parsed = parse(words.rest, argparse.Namespace(words=words, run_command=run_command))
        _set_variables(parsed)
        code = _command(name).main(parsed)
        if sys.stdout is not None:  # None if the stream is closed: `trundle … >&-`
            sys.stdout.flush()
        return code
    except SystemExit as system_exit:  # argparse raises it: with 0 after --help, with 2 for wrong usage
        return int(system_exit.code or 0)
    except TrundleError as error:
        named = f"{error} [{error.id}]" if error.id else str(error)
        message = str(error) if _has_location(str(error)) else f"{program}: error: {named}"
        print(colored(message, sys.stderr), file=sys.stderr)
        if error.missing_packages and name != "pack":
            from .fetching import offer

            if offer(error.missing_packages):
                return _run(name, arguments, program=program)
        return EXIT_INPUT
    except BrokenPipeError:  # `trundle topic echo … | head`
        _discard_stdout()
        return EXIT_OK
    except OSError as error:  # mostly for files that cannot be written
        if shortage(error) is not None:
            raise
        if error.filename is not None:
            print(f"{program}: error: {error.filename}: {error.strerror}", file=sys.stderr)
        elif error.errno in _DISK_ERRORS:
            print(f"{program}: error: the output cannot be written: {error.strerror}", file=sys.stderr)
            _discard_stdout()
        else:
            raise
        return EXIT_INPUT


def _discard_stdout() -> None:
    """Redirect stdout to /dev/null, also for the flush when Python exits."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _set_error_handler(*, as_xml: bool) -> None:
    """Escape characters that stdout's encoding lacks, as stderr does: file names may hold any bytes."""
    out = sys.stdout
    if isinstance(out, TextIOWrapper) and (out.encoding.lower(), out.errors) != ("utf-8", "surrogateescape"):
        out.reconfigure(errors="xmlcharrefreplace" if as_xml else "backslashreplace")


def _apply_remap_arguments(words: Arguments) -> None:
    """Apply `__ns:=`, `__master:=`, `__ip:=` and `__hostname:=` as their environment variables."""
    variables = {"ROS_NAMESPACE": words.namespace, "ROS_MASTER_URI": words.master_uri, "ROS_HOSTNAME": words.host}
    os.environ.update({variable: value for variable, value in variables.items() if value})


def _set_variables(parsed: argparse.Namespace) -> None:
    """Apply options as their environment variables, which child processes inherit."""
    options = [name for name in ("allow_outside", "lenient") if getattr(parsed, name, False)]
    if options:
        from trundle.robots import packages

        os.environ.update({getattr(packages, name.upper()): "1" for name in options})


def _has_location(message: str) -> bool:
    return ": error: " in message


def _command(name: str) -> CommandModule:
    with quiet_imports():
        return cast(CommandModule, importlib.import_module(f"trundle.app.cli.{name}"))


def make_parser(
    name: str, parser: argparse.ArgumentParser | None = None, *, program: str = ""
) -> argparse.ArgumentParser:
    """Return the parser of a command's module.

    Args:
        name: name of the module.
        parser: parser to extend; None: a new one.
        program: program's name in usage and examples; empty: `trundle NAME`.
    """
    command = _command(name)
    program = program or f"trundle {name}"
    summary = (command.__doc__ or _parsed_docstring(command) or "").partition("\n")[0]
    parser = parser or argparse.ArgumentParser(prog=program, formatter_class=HelpFormatter)
    examples = command.EXAMPLES.strip("\n").replace(f"trundle {name}", program)
    command.configure(parser)
    describe(parser, examples, summary)
    return parser


def _parsed_docstring(command: CommandModule) -> str | None:
    """Return a module's docstring as its file has it; `python -OO` drops those of modules."""
    return ast.get_docstring(ast.parse(Path(command.__file__).read_bytes()))


def _overview() -> str:
    width = max(map(len, COMMANDS))
    lines = [f"  {name:<{width}}  {summary}" for name, summary in COMMANDS.items()]
    return "\n".join(
        [
            "examples:",
            "  trundle run model://rp2w                    simulate a robot, shown in the browser",
            "  trundle launch PACKAGE FILE.launch          start a ROS 1 launch file",
            "  trundle COMMAND --help                      examples and options of a command",
            "",
            "commands:",
            *lines,
            "",
            'tab completion: eval "$(register-python-argcomplete trundle)"',
            "         fish: register-python-argcomplete --shell fish trundle | source",
        ]
    )


def _complete() -> None:
    """Serve the shell's completion request; does not return."""
    import argcomplete

    from .completion import complete

    parser = argparse.ArgumentParser(prog="trundle")
    subparsers = parser.add_subparsers()
    typed = os.environ.get("COMP_LINE", "").split()
    for name, summary in COMMANDS.items():
        subparser = subparsers.add_parser(name, help=summary, formatter_class=HelpFormatter)
        if name in typed:
            complete(make_parser(name, subparser), name)
    argcomplete.autocomplete(parser)


def _complete_original(program: str) -> None:
    """Serve the completion request of a command under its name in ROS; does not return."""
    import argcomplete

    from .completion import complete

    name, *words = ORIGINALS[program]
    line = os.environ.get("COMP_LINE", "")
    typed, replaced = line.partition(" ")[0], " ".join([program, *words])
    os.environ["COMP_LINE"] = replaced + line[len(typed) :]
    point = int(os.environ.get("COMP_POINT") or len(line))
    os.environ["COMP_POINT"] = str(point + len(replaced) - len(typed))
    parser = make_parser(name, program=program)
    complete(parser, name)
    argcomplete.autocomplete(parser)

"""`trundle bag play`: publishes the messages of bags."""

import argparse
import select
import sys
import time
from collections.abc import Callable, Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from trundle.ros import BagReader, Node, Player, PlayerOptions, open_bag

from ..graph_command import running_node

_CONNECTED_S = 0.1
_TERMINAL_S = 0.1
"""Update interval of the status line."""


def main(args: argparse.Namespace) -> int:
    """Play to the end, or until Ctrl-C."""
    names = [*args.bags, *args.more_bags]
    if not names:
        args.refuse("You must specify at least 1 bag file to play back.")
    print_text = _print_nothing if args.quiet else _print
    with ExitStack() as stack, running_node("play", args.words) as (loop, node):
        bags: list[BagReader] = []
        for name in names:
            print_text(f"[ INFO] [{time.time():.9f}]: Opening {name}\n")
            bags.append(stack.enter_context(open_bag(Path(name))))
        if args.prefix:
            print_text(f"[ INFO] [{time.time():.9f}]: Using prefix '{args.prefix}'' for topics \n")
        print_text("\n")
        player = Player(node, bags, _options(args))
        if player.is_empty:
            print("No messages to play on specified topics.  Exiting.", file=sys.stderr)
            return 0
        if args.rate_control_topic:
            print_text("Creating rate control topic subscriber... done.\n")
        publishers = player.advertise()
        player.is_paused = args.pause
        _provide_pausing(node, player)
        loop.run(node.wait_registered(), None)
        print_text(f"Waiting {args.delay:g} seconds after advertising topics...")
        time.sleep(max(0.0, args.delay))
        print_text(" done.\n")
        print_text("\nHit space to toggle paused, or 's' to step.\n")
        if args.wait_for_subscribers:
            print_text("Waiting for subscribers.\n")
            while not all(publisher.has_subscribers for publisher in publishers):
                time.sleep(_CONNECTED_S)
            print_text("Finished waiting for subscribers.\n")
        with _keys() as pressed:
            poll = _PlayerConsole(player, pressed, quiet=args.quiet)
            player.play(poll)
            if args.keep_alive:
                player.keep_alive(poll)
            while args.loop:
                player.play(poll)
        print_text("\nDone.\n")
        loop.flush_deliveries()  # slow subscribers get a little more time
        time.sleep(_CONNECTED_S)
    return 0


def _options(args: argparse.Namespace) -> PlayerOptions:
    return PlayerOptions(
        rate=args.rate,
        start_s=args.start,
        duration_s=args.duration or None,  # 0 means no limit, as in the original
        topics=frozenset(args.topics),
        pause_topics=frozenset(args.pause_topics),
        prefix=args.prefix,
        clock_hz=args.hz if args.clock else None,
        immediate=args.immediate,
        queue_size=args.queue,
        skip_empty_s=args.skip_empty,
        rate_control_topic=args.rate_control_topic,
        rate_control_s=args.rate_control_max_delay,
    )


def _provide_pausing(node: Node, player: Player) -> None:
    def pause(request: Any) -> dict[str, Any]:
        if player.is_paused == request.data:
            return {"success": False, "message": f"Bag is already {'paused' if request.data else 'running'}."}
        player.is_paused = request.data
        return {"success": True, "message": f"Playback is now {'paused' if request.data else 'resumed'}"}

    node.advertise_service("~pause_playback", "std_srvs/SetBool", pause)


class _PlayerConsole:
    """Handles keys and prints the status line."""

    def __init__(self, player: Player, pressed: Callable[[], str], *, quiet: bool) -> None:
        self._player = player
        self._pressed = pressed
        self._shows_status = sys.stdout.isatty() and not quiet
        self._printed_s = 0.0

    def __call__(self) -> None:
        player = self._player
        match self._pressed():
            case " ":
                player.is_paused = not player.is_paused
            case "s":
                player.steps += player.is_paused
            case "t":
                player.uses_pause_topics = not player.uses_pause_topics
            case _:
                pass
        if self._shows_status and time.monotonic() - self._printed_s > _TERMINAL_S:
            self._printed_s = time.monotonic()
            now, start, end = (ns / 1e9 for ns in (player.now_ns, player.start_ns, player.end_ns))
            state = "PAUSED " if player.is_paused else "RUNNING"
            _print(
                f" [{state}]  Bag Time: {now:13.6f}   Duration: {max(0.0, now - start):.6f} / {end - start:.6f}"
                "               \r"
            )


@contextmanager
def _keys() -> Generator[Callable[[], str]]:
    """Yield a function that returns the pressed key, or ''; restore the terminal at the end."""
    if not sys.stdin.isatty():
        yield lambda: ""
        return
    try:
        import termios
        import tty
    except ImportError:  # Windows
        print("this Python cannot read single keys (it has no termios): no pause, no step", file=sys.stderr)
        yield lambda: ""
        return
    terminal = sys.stdin.fileno()
    old_modes = termios.tcgetattr(terminal)
    tty.setcbreak(terminal)
    try:
        yield lambda: sys.stdin.read(1) if select.select([sys.stdin], [], [], 0)[0] else ""
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, old_modes)


def _print(text: str) -> None:
    print(text, end="", flush=True)


def _print_nothing(_: str) -> None:
    pass

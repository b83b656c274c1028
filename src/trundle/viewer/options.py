"""A folder for each node with options: what is ticked, written or counted there goes to the node."""

import math
from collections.abc import Callable

import viser

from .content import OptionGroup, PanelOption
from .requests import Request, SetOption

_MOST = 1e15
"""A bound beyond is none: what a page counts in, a JavaScript number, holds integers up to here."""


def add_options(server: viser.ViserServer, groups: tuple[OptionGroup, ...], send: Callable[[Request], None]) -> None:
    """Add them to the panel."""
    for group in groups:
        with server.gui.add_folder(group.name, expand_by_default=len(groups) == 1):
            for option in group.options:
                _add(server, group.name, option, send)


def _add(server: viser.ViserServer, group: str, option: PanelOption, send: Callable[[Request], None]) -> None:
    gui, value, hint = server.gui, option.value, option.hint or None
    if isinstance(value, bool):
        box = gui.add_checkbox(option.name, value, hint=hint)
        box.on_update(lambda _: send(SetOption(group, option.name, box.value)))
    elif isinstance(value, str):
        line = gui.add_text(option.name, value, hint=hint)
        line.on_update(lambda _: send(SetOption(group, option.name, line.value)))
    else:
        low = option.lower if math.fabs(option.lower) < _MOST else None
        high = option.upper if math.fabs(option.upper) < _MOST else None
        kind = type(value)
        number = gui.add_number(
            option.name, value, min=None if low is None else kind(low), max=None if high is None else kind(high),
            step=kind(1) if kind is int else kind(0.001), hint=hint,
        )  # fmt: skip
        number.on_update(lambda _: send(SetOption(group, option.name, kind(number.value))))

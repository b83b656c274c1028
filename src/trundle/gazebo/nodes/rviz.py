"""rviz/rviz: opens the page, with the original's publishers, subscribers and services."""

import os
from typing import TYPE_CHECKING

from trundle.ros import Message, Node

from .host import NodeHost

if TYPE_CHECKING:
    from trundle.ros.message_types import std_srvs

_SEND_FILE_PATH = "std_msgs/String path\n---\nbool success\n"
_OPTIONS_WITH_VALUE = ("-d", "--display-config", "-f", "--fixed-frame", "-s", "--splash-screen", "--help-file", "-t")


class Rviz:
    """Opens the launch's page; idles without a display."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        self._node = node
        self._display = host.display
        self._options = _options(arguments)

    async def run(self) -> int:
        """Show until the page is closed; without a display, until shutdown."""
        node = self._node
        config = self._options.get("-d") or self._options.get("--display-config")
        if config is not None and not os.path.isfile(config):
            node.log.warn(f"no rviz config {config!r}; the default view is shown")
            config = None
        # Topics of the tools in the default layout; the page publishes the clicks.
        node.advertise("/initialpose", "geometry_msgs/PoseWithCovarianceStamped", queue_size=1)
        node.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped", queue_size=1)
        node.advertise("/clicked_point", "geometry_msgs/PointStamped", queue_size=1)
        node.messages.add_service("rviz/SendFilePath", _SEND_FILE_PATH)
        node.advertise_service("~load_config", "rviz/SendFilePath", _refuse)
        node.advertise_service("~save_config", "rviz/SendFilePath", _refuse)
        node.advertise_service("~reload_shaders", "std_srvs/Empty", _empty_response)
        if self._display is None:
            # Registered here, so that the graph is the same with and without a page.
            node.subscribe("/tf", "tf2_msgs/TFMessage", _ignore, queue_size=1)
            node.subscribe("/tf_static", "tf2_msgs/TFMessage", _ignore, queue_size=1)
            await node.closed.wait()
            return 0
        fixed_frame = self._options.get("-f") or self._options.get("--fixed-frame")
        return await self._display.show(node, config=config, fixed_frame=fixed_frame)


def _options(arguments: list[str]) -> dict[str, str]:
    """Parse options with values; a file without an option is a config, as with `-d`."""
    options: dict[str, str] = {}
    remaining = iter(arguments)
    for argument in remaining:
        name, equals, value = argument.partition("=")
        if name in _OPTIONS_WITH_VALUE:
            options[name] = value if equals else next(remaining, "")
        elif not argument.startswith("-") and "-d" not in options:
            options["-d"] = argument
    return options


def _ignore(_message: Message) -> None:
    """No-op callback."""


def _empty_response(_request: "std_srvs.EmptyRequest") -> dict[str, object]:
    return {}


def _refuse(_request: Message) -> dict[str, object]:
    """Refuse: the page cannot load or save configs at run time."""
    return {"success": False}

"""nodelet/nodelet: idle managers, and nodelets with a built-in replacement."""

import os
from pathlib import Path

from trundle.robots.packages import Packages
from trundle.ros import Node

from .catalog import NODELETS
from .find import BuiltinReplacement, missing_nodelet
from .host import NodeHost


class Nodelet:
    """Runs the nodelet that its arguments name; the launch reports nodelets without a stand-in and skips them."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        self._node = node
        self._arguments = [argument for argument in arguments if not argument.startswith("--")]
        self._host = host

    async def run(self) -> int:
        """Run until cancelled."""
        node = self._node
        match self._arguments:
            case ["manager", *_]:
                await node.closed.wait()
                return 0
            case ["load", name, _, *rest] | ["standalone", name, *rest]:
                if name in NODELETS:
                    return await BuiltinReplacement(NODELETS[name]).load()(node, rest, self._host).run()
                env = {**os.environ, **self._host.env}
                node.log.error(missing_nodelet(name, Packages(env, start=Path.cwd()).find_package, env))
                return 1
            case ["unload", *_]:
                return 0
            case invalid:
                node.log.error(
                    f"usage: nodelet manager|load|standalone|unload CLASS [MANAGER]; got {' '.join(invalid)!r}"
                )
                return 1

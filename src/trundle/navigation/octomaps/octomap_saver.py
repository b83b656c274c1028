"""octomap_server/octomap_saver: writes the octomap of a server to a file."""

from pathlib import Path

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes import NodeHost
from trundle.ros import Node, RosError

from .octomap_file import write_octomap

_USAGE = "usage: octomap_saver [-f] FILE.bt|FILE.ot"


class OctomapSaver:
    """Asks a server for its map and exits: `octomap_binary`, or with -f `octomap_full`."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Save; exit code 1 on invalid arguments and write errors."""
        node = self._node
        is_full = self._arguments[:1] == ["-f"]
        files = self._arguments[1:] if is_full else self._arguments
        file = Path(files[0] if len(files) == 1 else "")
        if file.suffix not in (".bt", ".ot"):
            node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 1
        service = "octomap_full" if is_full else "octomap_binary"
        try:
            await node.wait_for_service(service)
            octomap = (await node.call_service(service, "octomap_msgs/GetOctomap")).map
        except RosError as error:
            node.log.error(str(error))
            return 1
        binary = bool(octomap.binary)
        if binary == (file.suffix == ".ot"):
            needed = ".bt, without -f," if binary else ".ot, with -f,"
            node.log.error(f"{file}: the map has {'no ' if binary else ''}log-odds; a file {needed} takes it")
            return 1
        data = np.asarray(octomap.data, dtype=np.int8).view(np.uint8)
        if not len(data):
            node.log.error(f"{node.resolve(service)}: the map is empty; nothing was written")
            return 1
        try:
            write_octomap(file, data, kind=str(octomap.id), resolution=float(octomap.resolution), binary=binary)
        except UsageError as error:
            node.log.error(str(error))
            return 1
        node.log.info(f"Map received ({len(data)} bytes, {octomap.resolution:g} m res), written to {file}")
        return 0

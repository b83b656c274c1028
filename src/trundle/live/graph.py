"""ROS graph of a run: an existing one, or one started here."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Self

from trundle.base.diagnostics import UsageError
from trundle.base.shortage import too_few_files
from trundle.base.signals import blind_wait
from trundle.ros import Core, GraphLoop, MasterProxy, MasterUnreachableError, PortTakenError, RosError, host_and_port

DEFAULT_PORT = 11311
_MIN_FILES = 32
"""File descriptors that a master with two nodes needs; with fewer, connections would wait forever."""
_LOCAL = frozenset({"localhost", "127.0.0.1", "::1", "0.0.0.0"})


class Graph:
    """Loop of this process's nodes, URI of their master, and the master itself if this process started it."""

    def __init__(self, loop: GraphLoop, master_uri: str, core: Core | None, host: str) -> None:
        self.loop = loop
        self.master_uri = master_uri
        self.core = core
        self.host = host

    @classmethod
    def open(
        cls,
        environment: Mapping[str, str],
        *,
        host: str,
        ports: Sequence[int] = (),
        rosout: bool = True,
        log_folder: Callable[[str], Path | None] | None = None,
    ) -> Self:
        """Join the master of ROS_MASTER_URI, else the default one; start it if none answers.

        Args:
            environment: environment variables; ROS_MASTER_URI is read.
            host: address that a master started here binds.
            ports: without ROS_MASTER_URI, start a new master at the first free port (0: any) rather than join the
                default one, so that runs side by side have separate graphs.
            rosout: True: a master started here gets a /rosout node.
            log_folder: run_id → log folder of a master started here, which it creates.

        Raises:
            UsageError: ROS_MASTER_URI is invalid or names another machine without a master, or this process may open
                too few files.
        """
        if shortage := too_few_files(_MIN_FILES):
            raise UsageError(shortage)
        uri_from_env = environment.get("ROS_MASTER_URI")
        uri = uri_from_env or f"http://localhost:{DEFAULT_PORT}"
        try:
            machine, port = host_and_port(uri)
        except RosError as error:
            raise UsageError(f"ROS_MASTER_URI is {error}") from None
        loop = GraphLoop()
        loop.start()
        try:
            if (uri_from_env or not ports) and _answers(uri):
                return cls(loop, uri, None, host)
            if machine not in _LOCAL:
                raise UsageError(
                    f"no ROS master answers at {uri} (ROS_MASTER_URI); start one there, or unset ROS_MASTER_URI"
                )
            new_core = partial(Core, loop, host=host, rosout=rosout, log_folder=log_folder)
            core = _start_core(loop, new_core, (port,) if uri_from_env or not ports else ports)
            return cls(loop, core.uri, core, host)
        except BaseException:
            loop.stop()
            raise

    @property
    def summary(self) -> str:
        """One line: URI of the master, and whether it was started or joined."""
        return f"ROS master started: {self.master_uri}" if self.core is not None else _joined(self.master_uri)

    def close(self) -> None:
        """Shut down every node here, then the master if it was started here."""
        try:
            if self.core is not None:
                self.loop.run(self.core.stop())
        finally:
            self.loop.stop()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def master_notice(environment: Mapping[str, str]) -> str | None:
    """One line about the master of ROS_MASTER_URI, which `Graph.open` will join; None if it does not answer."""
    uri = environment.get("ROS_MASTER_URI")
    try:
        return None if not uri or not _answers(uri) else f"{_joined(uri)}, which ROS_MASTER_URI names"
    except RosError:  # `Graph.open` reports it
        return None


def _joined(uri: str) -> str:
    return f"ROS master joined: {uri}"


def _answers(uri: str) -> bool:
    try:
        with blind_wait():
            MasterProxy(uri).call("getPid")
    except MasterUnreachableError:
        return False
    return True


def _start_core(loop: GraphLoop, new_core: Callable[..., Core], ports: Sequence[int]) -> Core:
    """Start a master at the first free port.

    Raises:
        PortTakenError: all are taken.
    """
    for port in ports:
        core = new_core(port=port)
        try:
            loop.run(core.start())
        except PortTakenError:
            if port == ports[-1]:
                raise
            continue
        return core
    raise AssertionError("ports is not empty")

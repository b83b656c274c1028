"""The ROS graph that a run takes part in: the one there is, or one started here."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Self

from trundle.diagnostics import UsageError
from trundle.ros import Core, GraphLoop, MasterProxy, MasterUnreachableError, PortTakenError, RosError, host_and_port

DEFAULT_PORT = 11311
_LOCAL = frozenset({"localhost", "127.0.0.1", "::1", "0.0.0.0"})


class Graph:
    """A loop for this process's nodes, the master they register with, and that master itself if it is ours."""

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
        """Join the master that ROS_MASTER_URI names, else the default one; start it where none answers.

        Args:
            environment: ROS_MASTER_URI is read from it.
            host: address that a master started here binds.
            ports: with no ROS_MASTER_URI, where to start a new master, the first that is free (0: any), rather than
                join the default one, so that ten runs side by side do not meet.
            rosout: whether a master that is started here has /rosout beside it.
            log_folder: makes the folder for the logs of a master that is started here, from the run_id.

        Raises:
            UsageError: ROS_MASTER_URI is no address, or names another machine, and nobody answers there.
        """
        named = environment.get("ROS_MASTER_URI")
        uri = named or f"http://localhost:{DEFAULT_PORT}"
        try:
            machine, port = host_and_port(uri)
        except RosError as error:
            raise UsageError(f"ROS_MASTER_URI is {error}") from None
        loop = GraphLoop()
        loop.start()
        try:
            if (named or not ports) and _answers(uri):
                return cls(loop, uri, None, host)
            if machine not in _LOCAL:
                raise UsageError(
                    f"no ROS master answers at {uri} (ROS_MASTER_URI); start one there, or unset ROS_MASTER_URI"
                )
            new_core = partial(Core, loop, host=host, rosout=rosout, log_folder=log_folder)
            core = _start_core(loop, new_core, (port,) if named or not ports else ports)
            return cls(loop, core.uri, core, host)
        except BaseException:
            loop.stop()
            raise

    @property
    def summary(self) -> str:
        """One line that says which graph this is."""
        return f"ROS master started: {self.master_uri}" if self.core is not None else _joined(self.master_uri)

    def close(self) -> None:
        """Shut down every node here, then the master if it is ours."""
        try:
            if self.core is not None:
                self.loop.run(self.core.stop(), timeout_s=2.0)
        finally:
            self.loop.stop()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def master_notice(environment: Mapping[str, str]) -> str | None:
    """Say which graph ROS_MASTER_URI has `Graph.open` join, if a master answers there."""
    uri = environment.get("ROS_MASTER_URI")
    try:
        return None if not uri or not _answers(uri) else f"{_joined(uri)}, which ROS_MASTER_URI names"
    except RosError:  # `Graph.open` says what is wrong with it
        return None


def _joined(uri: str) -> str:
    return f"ROS master joined: {uri}"


def _answers(uri: str) -> bool:
    try:
        MasterProxy(uri, timeout_s=2.0).call("getPid")
    except MasterUnreachableError:
        return False
    return True


def _start_core(loop: GraphLoop, new_core: Callable[..., Core], ports: Sequence[int]) -> Core:
    """Start a master at the first port that is free.

    Raises:
        PortTakenError: none is.
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
    raise AssertionError("there is a port to try")

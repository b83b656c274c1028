"""Programs of controller_manager: load, start, stop and unload controllers of a simulated robot."""

import argparse
import asyncio
import contextlib
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from trundle.base.diagnostics import UsageError
from trundle.ros import Message, Node, RosError

from .host import NodeHost

_PACKAGE = "controller_manager_msgs"
_SHUTDOWN_TIMEOUT_S = 1.0
_BEST_EFFORT, _STRICT = 1, 2


class _ArgumentParser(argparse.ArgumentParser):
    """Argument parser that raises a UsageError instead of exiting."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message}; {self.format_usage().strip()}")


class _ControllerManagerClient:
    """Client of one robot's controller_manager services."""

    def __init__(self, node: Node, namespace: str = "") -> None:
        self._node = node
        self._prefix = f"{namespace.rstrip('/')}/controller_manager" if namespace else "controller_manager"

    async def wait(self, timeout_s: float | None) -> None:
        """Wait for the services.

        While the simulation loads, a timeout is extended, since the first convex decomposition of large meshes takes
        long. There is no default timeout: the original's 30 s are too short for a slow machine.

        Raises:
            RosError: timeout.
        """
        for name in ("load_controller", "switch_controller", "unload_controller"):
            while True:
                try:
                    await self._node.wait_for_service(f"{self._prefix}/{name}", timeout_s)
                except RosError:
                    if not self._node.loop.work.is_busy:
                        raise
                else:
                    break

    async def load(self, name: str) -> bool:
        """Load a controller from its parameters."""
        return (await self._call("load_controller", "LoadController", name=name)).ok

    async def unload(self, name: str) -> bool:
        """Unload a controller."""
        return (await self._call("unload_controller", "UnloadController", name=name)).ok

    async def switch(self, *, start: Sequence[str] = (), stop: Sequence[str] = (), strictness: int = _STRICT) -> bool:
        """Stop and start controllers."""
        fields = {"start_controllers": list(start), "stop_controllers": list(stop), "strictness": strictness}
        return (await self._call("switch_controller", "SwitchController", **fields)).ok

    async def loaded(self) -> list[Message]:
        """Loaded controllers."""
        return list((await self._call("list_controllers", "ListControllers")).controller)

    async def types(self) -> list[str]:
        """Available controller types."""
        return list((await self._call("list_controller_types", "ListControllerTypes")).types)

    async def _call(self, service: str, kind: str, **fields: Any) -> Message:
        return await self._node.call_service(f"{self._prefix}/{service}", f"{_PACKAGE}/{kind}", fields)


class Spawner:
    """Loads and starts controllers; stops and unloads them when the node is shut down."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._loaded: list[str] = []

    async def run(self) -> int:
        """Run until cancelled."""
        node = self._node
        parser = _ArgumentParser(prog="spawner", add_help=False)
        parser.add_argument("--stopped", action="store_true")
        parser.add_argument("--wait-for", metavar="topic")
        parser.add_argument("--namespace", default="")
        parser.add_argument("--timeout", type=float)
        parser.add_argument("--no-timeout", action="store_true")
        parser.add_argument("--shutdown-timeout", type=float, default=_SHUTDOWN_TIMEOUT_S)
        parser.add_argument("controllers", nargs="+")
        try:
            options = parser.parse_args(self._arguments)
            manager = _ControllerManagerClient(node, options.namespace)
            node.log.info("Controller Spawner: Waiting for service controller_manager/load_controller")
            await manager.wait(None if options.no_timeout else options.timeout)
            if options.wait_for:
                await self._wait_for(options.wait_for)
            await self._spawn(manager, options.controllers, stopped=options.stopped)
        except (UsageError, RosError) as error:
            node.log.error(f"Controller Spawner: {error}")
            return 1
        await node.closed.wait()
        with contextlib.suppress(RosError, OSError):
            async with asyncio.timeout(options.shutdown_timeout):
                await manager.switch(stop=self._loaded, strictness=_BEST_EFFORT)
                for name in reversed(self._loaded):
                    await manager.unload(name)
        return 0

    async def _spawn(self, manager: _ControllerManagerClient, names: list[str], *, stopped: bool) -> None:
        node = self._node
        for name in names:
            node.log.info(f"Loading controller: {name}")
            if await manager.load(name):
                self._loaded.append(name)
            else:
                node.log.error(f"Failed to load {name}")
        node.log.info(f"Controller Spawner: Loaded controllers: {', '.join(self._loaded)}")
        if stopped or not self._loaded:
            return
        if await manager.switch(start=self._loaded):
            node.log.info(f"Started controllers: {', '.join(self._loaded)}")
        else:
            node.log.error(f"Failed to start controllers: {', '.join(self._loaded)}")

    async def _wait_for(self, topic: str) -> None:
        """Wait for `true` on a std_msgs/Bool topic."""
        received = asyncio.Event()

        def on_message(message: Message) -> None:
            if message.data:
                received.set()

        self._node.log.info(f"Controller Spawner: Waiting for {topic}")
        subscription = self._node.subscribe(topic, "std_msgs/Bool", on_message, on_loop=True)
        await received.wait()
        subscription.unregister()


class Unspawner:
    """Stops controllers; starts them again when the node is shut down."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Run until cancelled."""
        node = self._node
        parser = _ArgumentParser(prog="unspawner", add_help=False)
        parser.add_argument("--namespace", default="")
        parser.add_argument("controllers", nargs="+")
        try:
            options = parser.parse_args(self._arguments)
            manager = _ControllerManagerClient(node, options.namespace)
            await manager.wait(None)
            if not await manager.switch(stop=options.controllers):
                raise UsageError(f"could not stop {', '.join(options.controllers)}")
        except (UsageError, RosError) as error:
            node.log.error(f"unspawner: {error}")
            return 1
        node.log.info(f"Stopped controllers: {', '.join(options.controllers)}")
        await node.closed.wait()
        with contextlib.suppress(RosError, OSError):
            async with asyncio.timeout(_SHUTDOWN_TIMEOUT_S):
                await manager.switch(start=options.controllers, strictness=_BEST_EFFORT)
        return 0


class ControllerManagerTool:
    """Command-line tool: list, list-types, load, unload, start, stop, spawn, kill, reload-libraries."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Execute one command."""
        parser = _ArgumentParser(prog="controller_manager", add_help=False)
        commands = ("list", "list-types", "load", "unload", "start", "stop", "spawn", "kill", "reload-libraries")
        parser.add_argument("command", choices=commands)
        parser.add_argument("controllers", nargs="*")
        try:
            options = parser.parse_args(self._arguments)
            manager = _ControllerManagerClient(self._node)
            await manager.wait(None)
            return 0 if await self._run_command(manager, options.command, options.controllers) else 1
        except (UsageError, RosError) as error:
            self._node.log.error(f"controller_manager: {error}")
            return 1

    async def _run_command(self, manager: _ControllerManagerClient, command: str, names: list[str]) -> bool:
        match command:
            case "list":
                for controller in await manager.loaded():
                    claims = [f"{c.hardware_interface}: {', '.join(c.resources)}" for c in controller.claimed_resources]
                    print(
                        f"'{controller.name}' - '{controller.type}' ( {controller.state} ) {'; '.join(claims)}".rstrip()
                    )
                return True
            case "list-types":
                print("\n".join(await manager.types()))
                return True
            case "reload-libraries":
                return True
            case _:
                return all([await self._execute(manager, command, name) for name in names])

    async def _execute(self, manager: _ControllerManagerClient, command: str, name: str) -> bool:
        succeeded = True
        if command in ("load", "spawn"):
            succeeded = await manager.load(name)
        if command in ("start", "spawn"):
            succeeded = succeeded and await manager.switch(start=[name])
        if command in ("stop", "kill"):
            succeeded = await manager.switch(stop=[name])
        if command in ("unload", "kill"):
            succeeded = succeeded and await manager.unload(name)
        if not succeeded:
            print(f"could not {command} {name!r}; see the log of the robot's controller_manager", file=sys.stderr)
            return False
        past_tense = {"load": "Loaded", "unload": "Unloaded", "start": "Started", "stop": "Stopped", "spawn": "Spawned"}
        print(f"{past_tense.get(command, 'Killed')} {name!r} successfully")
        return True

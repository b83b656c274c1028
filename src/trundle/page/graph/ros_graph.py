"""The page's node on the ROS graph, which survives restarts of the master, and the clients' requests to the graph."""

import asyncio
import contextlib
import logging
import os
from collections.abc import Coroutine
from typing import Any

from trundle.ros import (
    Clock,
    GraphLoop,
    MasterError,
    MasterUnreachableError,
    Node,
    RosError,
    SimClock,
    Subscription,
    WallClock,
    to_nsec,
)  # fmt: skip

from ..clients.connection import Connection
from ..clients.hub import Hub
from ..clients.protocol import (
    CLIENT_MESSAGE,
    CLIENT_SERVICE_CALL,
    ERROR,
    Advertise,
    ClientOperation,
    Drive,
    GetParameters,
    Release,
    SetParameters,
    SubscribeConnectionGraph,
    SubscribeParameterUpdates,
    Unadvertise,
    UnsubscribeConnectionGraph,
    UnsubscribeParameterUpdates,
)  # fmt: skip
from ..driving.dead_man_switch import Driving
from ..owner import Owner
from ..wire import GraphAddress
from .client_publishers import ClientPublishers
from .master_state import MasterState, graph_update, read_state
from .parameter_service import ParameterService
from .service_table import ServiceTable
from .topic_table import TopicTable

_PERIOD_S = 1.0
_log = logging.getLogger(__name__)
_WARN_AFTER_S = 5.0
"""Time without an answer of the master after which the page warns [s]; the wait itself has no limit."""
_CONDITION = "master"
_MAX_TASKS = 64
"""Limit of one client's pending requests for parameters."""


class RosGraph:
    """Node of the page; used on the loop only."""

    def __init__(self, address: GraphAddress, loop: GraphLoop, hub: Hub, owner: Owner) -> None:
        self._address = address
        self._loop = loop
        self._hub = hub
        self._state = MasterState()
        self._has_state = False
        self._topics = TopicTable(hub)
        self._services = ServiceTable(hub)
        self._parameters = ParameterService(hub)
        self._driving = Driving(owner.set_driven)
        self._publishers = ClientPublishers(is_shared=lambda topic: topic in self._driving.topics)
        self._graph_clients: set[Connection] = set()
        self._tasks: dict[Connection, set[asyncio.Task[None]]] = {}
        self._refresh_now = asyncio.Event()
        self._clock_subscription: Subscription | None = None
        self._node = self._new_node()

    @property
    def clock(self) -> Clock:
        """ROS time."""
        return self._node.clock

    # -- the node and its master

    @property
    def node_name(self) -> str:
        """Name of the page's node."""
        return self._node.name

    async def run(self) -> None:
        """Follow the graph while clients are connected."""
        while True:
            await self._hub.wait_client()
            try:
                await self._refresh()
            except Exception:  # a bug must not end the page
                _log.exception("the graph could not be read")
            self._refresh_now.clear()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._refresh_now.wait(), _PERIOD_S)

    async def stop(self) -> None:
        """Stop driven robots, and leave the graph."""
        self._driving.stop()
        await self._node.shutdown()

    async def _refresh(self) -> None:
        """Read the master's state; without a master, nothing changes."""
        warning = asyncio.get_running_loop().call_later(_WARN_AFTER_S, self._warn_unanswered)
        try:
            registered = await self._wait_registered()
            state = await read_state(self._node)
            await self._follow_time()
            if self._node.is_shut_down or not self._is_registered(registered, state):
                await self._replace_node()
                state = await read_state(self._node)
            await self._parameters.refresh(self._node)
        except MasterUnreachableError:
            self._warn_unanswered()
            return
        except (MasterError, ValueError, TypeError) as error:
            self._hub.set_condition(
                _CONDITION, f"the ROS master at {self._address.master_uri} answers with an error: {error}"
            )
            return
        finally:
            warning.cancel()
        self._hub.set_condition(_CONDITION, None)
        before, self._state, self._has_state = self._state, state, True
        await self._topics.update(self._node, state)
        await self._services.update(self._node, state)
        update = graph_update(before, state)
        if update is not None:
            for client in self._graph_clients:
                client.send(update)

    def _warn_unanswered(self) -> None:
        uri = self._address.master_uri
        self._hub.set_condition(_CONDITION, f"no ROS master answers at {uri}; trying again every second")

    async def _wait_registered(self) -> tuple[set[str], set[str]]:
        """Wait until the master has registered this node's topics; return the subscribed and the published ones."""
        registered = self._topics.subscribed, self._publishers.topics | self._driving.topics
        if not self._node.is_shut_down:
            await self._node.wait_registered()
        return registered

    def _is_registered(self, registered: tuple[set[str], set[str]], state: MasterState) -> bool:
        """True if the master has this node's registrations; a restarted master has not."""
        subscribed, published = registered
        name = self._node.name
        return all(name in state.subscribers.get(topic, ()) for topic in subscribed) and all(
            name in state.publishers.get(topic, ()) for topic in published
        )

    async def _replace_node(self) -> None:
        """Join the graph again."""
        old, self._node = self._node, self._new_node()
        self._loop.spawn(old.shutdown())
        await self._follow_time()
        await self._wait_registered()

    def _new_node(self) -> Node:
        node = Node(
            f"{self._address.name}_{self._address.number or os.getpid()}",
            loop=self._loop,
            master_uri=self._address.master_uri,
            host=self._address.host,
            rosout=False,
        )
        self._clock_subscription = None
        for part in (self._topics, self._publishers, self._driving):
            part.set_node(node)
        return node

    async def _follow_time(self) -> None:
        """Use simulated time while /use_sim_time is set."""
        node = self._node
        is_simulated = bool(await node.params.get("/use_sim_time", False))
        if is_simulated and self._clock_subscription is None:
            clock = SimClock(self._loop)
            self._clock_subscription = node.subscribe(
                "/clock", "rosgraph_msgs/Clock", lambda m: clock.set(to_nsec(m.clock)), queue_size=1, on_loop=True
            )
            node.clock = clock
        elif not is_simulated and self._clock_subscription is not None:
            self._clock_subscription.unregister()
            self._clock_subscription = None
            node.clock = WallClock()

    # -- clients

    def join(self, client: Connection) -> None:
        """Advertise services to a new client, and read the graph's state at once."""
        if not client.only_drives:
            self._services.offer(client)
        self._refresh_now.set()

    def leave(self, client: Connection) -> None:
        """Stop robots, and end topics and calls of a client that has disconnected."""
        self._driving.forget(client)
        self._publishers.forget(client)
        self._services.forget(client)
        self._parameters.forget(client)
        self._graph_clients.discard(client)
        for task in self._tasks.pop(client, ()):
            task.cancel()

    def receive(self, client: Connection, message: bytes) -> None:
        """Handle a binary message of a client."""
        opcode = message[0] if message else None
        if opcode == CLIENT_MESSAGE:
            self._publishers.publish(self._node, client, message)
        elif opcode == CLIENT_SERVICE_CALL:
            self._services.call(self._node, client, message)
        else:
            client.send_status(ERROR, f"unknown opcode {opcode} of a binary message")

    def operate(self, client: Connection, operation: ClientOperation) -> None:
        """Handle a text message of a client that concerns the graph."""
        node = self._node
        match operation:
            case Advertise():
                self._publishers.advertise(client, operation, self._state.subscribers)
            case Unadvertise():
                self._publishers.unadvertise(client, operation)
            case GetParameters():
                self._spawn(client, self._parameters.get(node, client, operation))
            case SetParameters():
                self._spawn(client, self._parameters.set(node, client, operation))
            case SubscribeParameterUpdates(names):
                self._spawn(client, self._parameters.watch(node, client, names))
            case UnsubscribeParameterUpdates(names):
                self._parameters.unwatch(node, client, names)
            case SubscribeConnectionGraph():
                self._graph_clients.add(client)
                if (update := graph_update(MasterState(), self._state)) is not None:
                    client.send(update)
            case UnsubscribeConnectionGraph():
                self._graph_clients.discard(client)
            case Drive() if client.speaks_trundle:
                if self._has_state:  # the topic's type is still unknown; the client repeats the command
                    self._driving.drive(client, operation, self._state.types)
            case Release(topic) if client.speaks_trundle:
                self._driving.release(client, topic)
            case _:
                client.send_status(ERROR, "this needs the subprotocol trundle.v1")

    def _spawn(self, client: Connection, work: Coroutine[Any, Any, None]) -> None:
        """Start a task for a client that waits for the master."""
        tasks = self._tasks.setdefault(client, set())
        if len(tasks) >= _MAX_TASKS:
            work.close()
            client.send_status(ERROR, f"{_MAX_TASKS} requests for parameters are pending")
            return
        task = asyncio.get_running_loop().create_task(_report_errors(client, work))
        tasks.add(task)
        task.add_done_callback(tasks.discard)
        task.add_done_callback(lambda _: work.close())  # a task that is cancelled at once never starts its coroutine


async def _report_errors(client: Connection, work: Coroutine[Any, Any, None]) -> None:
    """Do work for a client, and send errors of the master as status messages."""
    try:
        await work
    except RosError as error:
        client.send_status(ERROR, str(error))

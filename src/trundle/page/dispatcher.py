"""The page: routes messages of clients and of the owner to its parts."""

import asyncio
import os
import time
from collections.abc import Callable, Coroutine, Mapping
from importlib.metadata import version
from pathlib import Path

import msgspec
from aiohttp import MultipartReader

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.output_folder import find_target, save_files
from trundle.ros import GraphLoop, WallClock, open_bag

from .bag.source import BagSource
from .clients.assets import Assets
from .clients.connection import Connection
from .clients.hub import Hub
from .clients.outbox import Outbox
from .clients.protocol import (
    CAPABILITIES,
    ERROR,
    GRAPH_CAPABILITIES,
    TRUNDLE,
    TRUNDLE_DRIVE,
    ClientOperation,
    Echo,
    FetchAsset,
    PageRequest,
    Presence,
    Subscribe,
    Unsubscribe,
    UseTerminal,
    operation_decoder,
)  # fmt: skip
from .compared_recording import ComparedRecording
from .graph.ros_graph import RosGraph
from .lesson_answers import LessonAnswers
from .mailbox import Mailbox
from .owner import MAX_IN_FLIGHT, Owner, respond
from .picture_slots import PictureError
from .requests.answers import Answer, DefinitionText, FilesExist, SavedFile
from .requests.lessons import CheckLessonFile, ListLessons, OpenLesson
from .requests.request import (
    REQUEST_NAMES,
    ClientAction,
    Definition,
    PlotSeries,
    RenderView,
    SaveRvizAs,
    SocketAction,
)
from .requests.world import RenderModel
from .session import PageSession, RvizFile, Session
from .uploads.recording import compare_upload
from .uploads.upload_folder import Uploads
from .view_only import allows, allows_binary, allows_request
from .wire import (
    AddFile,
    FromServer,
    OpenMailbox,
    Respond,
    Served,
    SetNotice,
    SetSession,
    SetWorld,
    Start,
    TerminalInput,
    ToServer,
    Uploaded,
    encode_json,
)  # fmt: skip
from .world.camera_channel import TYPE as IMAGE, CameraChannel
from .world.channels import (
    PosesChannel,
    StateChannel,
    StreamChannel,
    WorldChannel,
    contacts_channel,
    differences_channel,
    joints_channel,
    line_channels,
    performance_channel,
    series_channel,
)
from .world.people import PeopleChannel
from .world.session_channel import SessionChannel
from .world.streams import TERMINAL
from .world.terminal_channel import TerminalChannel

_NO_GRAPH = "this page has no ROS graph"
_action_decoder = msgspec.json.Decoder(SocketAction)


class Page:
    """Content of the page; used on the loop only."""

    def __init__(self, start: Start, *, loop: GraphLoop, assets: Assets, send: Callable[[FromServer], None]) -> None:
        """Create it; `send` writes a message to the owner."""
        self.addresses = Served(url="", foxglove_url="", view_url="")
        self._session: Session = start.session
        self._saved_rviz: RvizFile | None = None
        """.rviz file that `SaveRvizAs` wrote last."""
        self._has_graph = start.graph is not None
        self._messages = loop.messages
        self._assets = assets
        self._owner = Owner(send, last_request=start.last_request)
        self._plotted: dict[Connection, frozenset[str]] = {}
        self._tasks: dict[bool, set[asyncio.Task[None]]] = {False: set(), True: set()}
        """Tasks of clients with full access (False) and of view-only clients (True)."""
        self._model_pictures = asyncio.Semaphore(1)
        self._lessons = LessonAnswers()
        self._uploads = Uploads(
            lambda folder: send(Uploaded(str(folder))),
            os.environ,
            folder=None if start.uploads is None else Path(start.uploads),
        )
        self._session_channel = SessionChannel(self.session_json)
        self._people = PeopleChannel()
        self._world = WorldChannel()
        self._state = StateChannel()
        streams: tuple[StreamChannel, ...] = ()
        if start.bag is None:
            world = self._world
            streams = (
                self._state,
                PosesChannel(world),
                joints_channel(world),
                contacts_channel(world),
                *line_channels(),
            )
            streams += (series_channel(), performance_channel())
        differences = differences_channel()
        streams += (differences,)
        self._streams: dict[str, StreamChannel] = {stream.topic: stream for stream in streams}
        self.hub = Hub(
            session_id=str(time.time_ns()),
            capabilities=CAPABILITIES + (GRAPH_CAPABILITIES if self._has_graph else ()),
            simulated_time_ns=self._simulated_time_ns,
        )
        self.hub.add_channels([self._session_channel, self._people, self._world, *streams])
        self.hub.polled += [self._people, *streams]
        bag = None if start.bag is None else open_bag(start.bag.file)
        self._bag = None if bag is None or start.bag is None else BagSource(bag, start.bag, self.hub)
        if self._bag is not None:
            self.hub.polled.append(self._bag)
        self._compared = ComparedRecording(
            self.hub,
            self._owner,
            differences,
            has_world=start.session.kind in ("simulation", "log"),
            has_topics=self._has_graph or bag is not None,
            bag_start_s=None if bag is None else bag.start_ns / 1e9,
        )
        self._reference = start.reference
        """Bag that is compared first."""
        self._graph = None if start.graph is None else RosGraph(start.graph, loop, self.hub, self._owner)

    async def run(self) -> None:
        """Serve until cancelled."""
        parts = [self.hub.run()]
        if self._reference is not None:
            parts.append(self._compared.open_first(self._reference))
        if self._graph is not None:
            parts.append(self._graph.run())
        await asyncio.gather(*parts)

    async def stop(self) -> None:
        """Stop driven robots, and remove uploads."""
        self._uploads.close()
        if self._graph is not None:
            await self._graph.stop()

    # -- for the owner

    def receive_from_owner(self, message: ToServer) -> None:
        """Handle a message of the owner."""
        match message:
            case SetSession(session):
                if session.rviz != self._session.rviz:
                    self._saved_rviz = None
                self._session = session
                self._session_channel.publish_change()
            case SetNotice(notice_id, text):
                self.hub.set_condition(notice_id, text)
            case AddFile(url, content):
                self._world.files[url] = content
            case SetWorld() as world:
                self._world.set(world.manifest, world.generation, world.urls)
                for topic in () if self._has_graph else world.camera_topics:
                    self._stream(topic)
            case OpenMailbox(stream, address):
                try:
                    self._stream(stream).open(Mailbox.open(address))
                except FileNotFoundError:  # the mailbox was replaced; the next message opens the new one
                    return
            case Respond() as answer:
                self._owner.receive(answer)

    def _stream(self, topic: str) -> StreamChannel:
        """Return the channel of a stream; those of cameras and terminals are created on first use."""
        if topic not in self._streams:
            if topic.startswith(TERMINAL):
                stream = TerminalChannel(topic)
            else:
                stream = CameraChannel(topic, schema=self._messages.definition(IMAGE))
            self._streams[topic] = stream
            self.hub.add_channels([stream])
            self.hub.polled.append(stream)
        return self._streams[topic]

    def _simulated_time_ns(self) -> int | None:
        shown_ns = self._state.time_ns if self._bag is None else self._bag.time_ns
        if self._graph is None or isinstance(self._graph.clock, WallClock):
            return shown_ns
        return self._graph.clock.now_ns() or shown_ns or 0  # before the first /clock

    # -- for HTTP

    def session_json(self, is_view_only: bool) -> bytes:
        """Return the content of `/session.json`; a view-only client gets view-only addresses."""
        session = self._session
        if self._saved_rviz is not None:
            session = msgspec.structs.replace(session, rviz=self._saved_rviz, fixed_frame=None)  # the file has a frame
        served = self.addresses
        page_session = PageSession(
            **msgspec.structs.asdict(session),
            version=version("trundle"),
            foxglove=served.view_url.replace("http:", "ws:", 1) if is_view_only else served.foxglove_url,
            node=None if self._graph is None else self._graph.node_name,
            view_only=is_view_only,
            token=None if is_view_only else served.url.partition("?token=")[2],
            view_token=served.view_url.partition("?token=")[2],
            network_urls=served.network_urls,
        )
        return msgspec.json.encode(page_session)

    def world_files(self) -> Mapping[str, bytes]:
        """Return the files of the simulated world and of a bag that topics are compared with, by URL."""
        return {**self._world.files, **self._compared.files}

    async def render(self, view: RenderView) -> bytes:
        """Return a picture of the scene as PNG.

        Raises:
            PictureError: the picture cannot be drawn.
        """
        if self._bag is not None:
            raise PictureError("only browsers with WebGL can draw a bag")
        return await self._owner.render(view)

    async def render_model(self, model: RenderModel) -> bytes:
        """Return a picture of a model as PNG or its shape as GLB, one model at a time.

        Raises:
            PictureError: the picture cannot be drawn.
        """
        if self._session.kind != "simulation":
            raise PictureError("only the page of a simulation can draw models")
        async with self._model_pictures:
            return await self._owner.render(model)

    async def upload(self, parts: MultipartReader) -> list[str]:
        """Receive a model and return the names of the models that can now be inserted.

        Raises:
            UsageError: the upload is refused.
        """
        if self._session.kind != "simulation":
            raise UsageError("models can only be inserted into a simulation")
        return await self._uploads.receive(parts)

    async def compare(self, parts: MultipartReader) -> str:
        """Receive a recording, compare the world or the topics with it, and return its title; raises UsageError."""
        return await compare_upload(parts, self._compared.open)

    # -- for clients

    def join(self, outbox: Outbox, *, protocol: str, is_view_only: bool) -> Connection:
        """Add a client that speaks a subprotocol."""
        only_drives = protocol == TRUNDLE_DRIVE
        client = Connection(
            outbox,
            self.hub,
            speaks_trundle=only_drives or protocol == TRUNDLE,
            is_view_only=is_view_only,
            only_drives=only_drives,
        )
        self.hub.add_client(client)
        if self._graph is not None:
            self._graph.join(client)
        return client

    def leave(self, client: Connection) -> None:
        """Remove a client."""
        if self._graph is not None:
            self._graph.leave(client)
        self.hub.remove_client(client)
        self._owner.forget(client)
        self._assets.forget(client)
        self._plot(client, frozenset())
        self._update_watched()

    def receive(self, client: Connection, message: bytes, *, is_text: bool) -> None:
        """Handle a message of a client; an invalid one is answered with a status message."""
        try:
            if is_text:
                self._operate(client, operation_decoder.decode(message), message)
            elif self._graph is not None:
                if allows_binary(client, message):
                    self._graph.receive(client, message)
            else:
                client.send_status(ERROR, _NO_GRAPH)
        except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
            client.send_status(ERROR, f"a message cannot be read: {error}")

    def _operate(self, client: Connection, operation: ClientOperation, message: bytes) -> None:
        if not allows(client, operation):
            return
        match operation:
            case Subscribe():
                client.subscribe(operation)
                self._update_watched()
            case Unsubscribe():
                client.unsubscribe(operation)
                self._update_watched()
            case Echo():
                client.echo(operation)
            case FetchAsset():
                self._assets.fetch(client, operation)
            case Presence(selection):
                self._people.select(client, selection)
            case UseTerminal(number, text, size):
                self._owner.send(TerminalInput(number, text, size))
            case PageRequest():
                self._request(client, operation, message)
            case _ if self._graph is not None:
                self._graph.operate(client, operation)
            case _:
                client.send_status(ERROR, _NO_GRAPH)

    def _request(self, client: Connection, request: PageRequest, message: bytes) -> None:
        client_id = request.id
        if not client.speaks_trundle:
            client.send_status(ERROR, "requests need the subprotocol trundle.v1")
            return
        if request.request not in REQUEST_NAMES:
            error = f"unknown request {request.request!r}: the page may be of another version, reload it"
            respond(client, client_id, error)
            return
        try:
            action = _action_decoder.decode(message)
        except msgspec.ValidationError as error:
            respond(client, client_id, f"not a request: {error}")
            return
        if not allows_request(client, client_id, action):
            return
        match action:
            case PlotSeries(series):
                self._plot(client, frozenset(series))
                respond(client, client_id)
            case Definition(type_name):
                self._answer(client, client_id, self._define(type_name))
            case SaveRvizAs():
                self._answer(client, client_id, self._save_rviz(action))
            case ListLessons() | OpenLesson() | CheckLessonFile():
                self._answer(client, client_id, self._lessons.answer(action, self._session.lesson))
            case _:
                self._act(client, client_id, action)

    def _plot(self, client: Connection, series: frozenset[str]) -> None:
        """Set the values that a client plots."""
        self._plotted.pop(client, None)
        if series:
            self._plotted[client] = series
        self._owner.set_plotted(frozenset().union(*self._plotted.values()))

    def _answer(self, client: Connection, client_id: int | str, work: Coroutine[None, None, Answer]) -> None:
        """Answer a client by work that may take time."""
        tasks = self._tasks[client.is_view_only]
        if len(tasks) >= MAX_IN_FLIGHT:
            work.close()
            respond(client, client_id, f"{MAX_IN_FLIGHT} requests are pending")
            return

        async def answer() -> None:
            try:
                respond(client, client_id, answer=encode_json(await work))
            except TrundleError as error:
                respond(client, client_id, str(error))

        task = asyncio.get_running_loop().create_task(answer())
        tasks.add(task)
        task.add_done_callback(tasks.discard)

    async def _define(self, type_name: str) -> DefinitionText:
        """Read the definition of a type."""
        return DefinitionText(definition=await asyncio.to_thread(self._messages.definition, type_name))

    async def _save_rviz(self, action: SaveRvizAs) -> SavedFile | FilesExist:
        """Write an .rviz file, unless it exists and must not be replaced."""
        exists = await asyncio.to_thread(_save_rviz, Path.cwd(), action)
        if exists is not None:
            return FilesExist(exists=exists)
        self._saved_rviz = RvizFile(name=action.file, text=action.text, writable=True, saved=True)
        return SavedFile(file=action.file)

    def _act(self, client: Connection, client_id: int | str, action: ClientAction) -> None:
        """Pass a request to the compared bag, to the one that is played, or to the owner."""
        if self._compared.handle(action):
            respond(client, client_id)
            return
        if self._bag is None:
            self._owner.request(client, client_id, action)
            return
        try:
            self._bag.handle(action)
        except UsageError as error:
            respond(client, client_id, str(error))
        else:
            respond(client, client_id)

    def _update_watched(self) -> None:
        self._owner.set_watched(frozenset(topic for topic, stream in self._streams.items() if stream.clients))


def _save_rviz(root: Path, action: SaveRvizAs) -> str | None:
    """Write an .rviz file; return its name if it exists and must not be replaced."""
    file = find_target(root, action.file, example="rviz/mine.rviz", suffixes=(".rviz",))
    return save_files(root, {file: action.text}, replace=action.replace)

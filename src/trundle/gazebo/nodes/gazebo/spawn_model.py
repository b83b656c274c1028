"""gazebo_ros/spawn_model: spawns a model from a file, a parameter or the model folders."""

import asyncio
import re
from typing import Literal

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.files import read_input, read_standard_input
from trundle.ros import Message, Node, ParameterError, RosError

from ..host import NodeHost
from .messages import pose_fields
from .spawn_arguments import SpawnRequest
from .trimesh import trimesh_sdf

_STDIN = "-stdin"

_MESH = re.compile(r"""(<\s*mesh\s[^>]*?\bfilename\s*=\s*["'])package://""")


class SpawnModel:
    """Spawns one model and exits; with -b, waits and deletes the model on exit."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Spawn; exit code 1 on failure, as in the original."""
        node = self._node
        try:
            request = SpawnRequest.read(self._arguments)
            if request.is_old:
                node.log.warn("Deprecated: the -gazebo tag is now -sdf")
            gazebo = request.texts.get("-gazebo_namespace", "/gazebo").rstrip("/")
            await self._wait_for(request.texts.get("-wait"), gazebo)
            await self._spawn(request, gazebo)
        except (TrundleError, RosError) as error:
            node.log.error(f"spawn_model: {error}")
            return 1
        if "-b" in request.flags:
            await self._delete_on_shutdown(request.texts["-model"], gazebo)
        return 0

    async def _spawn(self, request: SpawnRequest, gazebo: str) -> None:
        node, texts = self._node, request.texts
        xml, kind = await self._model(request)
        if "-package_to_model" in request.flags:
            xml = _MESH.sub(r"\1model://", xml)
        service = f"{gazebo}/spawn_{kind}_model"
        node.log.info(f"Waiting for service {service}")
        await node.wait_for_service(service)
        response = await node.call_service(
            service,
            "gazebo_msgs/SpawnModel",
            {
                "model_name": texts["-model"],
                "model_xml": xml,
                "robot_namespace": texts.get("-robot_namespace", node.resolve("x").rpartition("/")[0] or "/"),
                "initial_pose": pose_fields(request.pose),
                "reference_frame": texts.get("-reference_frame", ""),
            },
        )
        _check(response)
        node.log.info(f"Spawn status: {response.status_message}")
        if request.joints:
            response = await node.call_service(
                f"{gazebo}/set_model_configuration",
                "gazebo_msgs/SetModelConfiguration",
                {
                    "model_name": texts["-model"],
                    "urdf_param_name": texts.get("-param", ""),
                    "joint_names": list(request.joints),
                    "joint_positions": list(request.joints.values()),
                },
            )
            _check(response)
            node.log.info(response.status_message)
        if "-unpause" in request.flags:
            await node.call_service(f"{gazebo}/unpause_physics", "std_srvs/Empty")

    async def _model(self, request: SpawnRequest) -> tuple[str, Literal["urdf", "sdf"]]:
        """Return the text and format of the model."""
        texts = request.texts
        source = request.source
        if request.kind == "trimesh":
            with self._node.loop.work.pending("the model's file"):
                return await asyncio.to_thread(trimesh_sdf, texts["-file"], request.trimesh), "sdf"
        match source:
            case "-file":
                with self._node.loop.work.pending("the model's file"):
                    xml = await asyncio.to_thread(_read, texts["-file"])
            case "-param":
                xml = await self._parameter(texts["-param"])
            case "-stdin":
                xml = await asyncio.to_thread(_read, _STDIN)
            case _:
                uri = f"model://{texts['-database']}"
                return f"<sdf version='1.6'><include><uri>{uri}</uri></include></sdf>", "sdf"
        return xml, request.kind or "sdf"

    async def _parameter(self, name: str) -> str:
        try:
            xml = await self._node.params.get(name)
        except ParameterError as error:
            raise UsageError(str(error)) from None
        if not isinstance(xml, str) or not xml.strip():
            raise UsageError(f"parameter {self._node.resolve(name)} does not contain a model")
        return xml

    async def _wait_for(self, model: str | None, gazebo: str) -> None:
        """Wait until another model exists."""
        if model is None:
            return
        appeared = asyncio.Event()

        def on_message(message: Message) -> None:
            if model in message.name:
                appeared.set()

        self._node.log.info(f"Waiting for model {model} before proceeding.")
        subscription = self._node.subscribe(
            f"{gazebo}/model_states", "gazebo_msgs/ModelStates", on_message, queue_size=1
        )
        await appeared.wait()
        subscription.unregister()

    async def _delete_on_shutdown(self, model: str, gazebo: str) -> None:
        self._node.log.info("Waiting for shutdown to delete the model")
        try:
            await self._node.closed.wait()
        finally:
            fields = {"model_name": model}
            await self._node.call_service(f"{gazebo}/delete_model", "gazebo_msgs/DeleteModel", fields, timeout_s=1.0)


def _check(response: Message) -> None:
    if not response.success:
        raise UsageError(response.status_message)


def _read(file: str) -> str:
    try:
        return (read_standard_input() if file == _STDIN else read_input(file)).decode(errors="replace")
    except OSError as error:
        raise UsageError(f"{file}: {error.strerror}") from None

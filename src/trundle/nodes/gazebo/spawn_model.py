"""gazebo_ros/spawn_model: asks /gazebo for a model, from a file, a parameter or the model folders."""

import asyncio
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from trundle.diagnostics import TrundleError, UsageError
from trundle.ros import Message, Node, ParameterError, RosError
from trundle.spatial import Pose

from ..host import Host
from .messages import pose_fields

_NUMBERS = {"-x": "x", "-y": "y", "-z": "z", "-R": "roll", "-P": "pitch", "-Y": "yaw"}
_TEXTS = frozenset(
    {"-file", "-param", "-database", "-model", "-wait", "-reference_frame", "-gazebo_namespace", "-robot_namespace"}
)
_TIMEOUT_S = 60.0


@dataclass(slots=True)
class _Request:
    """The command line."""

    kind: Literal["urdf", "sdf"] | None = None
    texts: dict[str, str] = field(default_factory=dict[str, str])
    numbers: dict[str, float] = field(default_factory=dict[str, float])
    joints: dict[str, float] = field(default_factory=dict[str, float])
    flags: set[str] = field(default_factory=set[str])

    @classmethod
    def read(cls, words: list[str]) -> "_Request":
        """Sort the words.

        Raises:
            UsageError: one that is not known, or misses its value.
        """
        request = cls()
        rest = iter(words)
        try:
            for given in rest:
                word = "-" + given.lstrip("-")  # argparse takes both
                if word in ("-urdf", "-sdf"):
                    request.kind = "urdf" if word == "-urdf" else "sdf"
                elif word in ("-gazebo", "-trimesh"):
                    raise UsageError(f"{given}: this form is gone since 2014; write SDF (-sdf) or URDF (-urdf)")
                elif word in _NUMBERS:
                    request.numbers[_NUMBERS[word]] = float(next(rest))
                elif word == "-J":
                    name = next(rest)
                    request.joints[name] = float(next(rest))
                elif word in _TEXTS:
                    request.texts[word] = next(rest)
                elif word in ("-unpause", "-package_to_model", "-b", "-bond", "-stdin", "-static"):
                    request.flags.add(word)
                elif word not in ("-v", "-verbose"):
                    raise UsageError(f"no option {given!r}")
        except StopIteration:
            raise UsageError(f"{words[-1]} needs a value") from None
        except ValueError as error:
            raise UsageError(f"a number is needed: {error}") from None
        return request

    @property
    def pose(self) -> Pose:
        return Pose.from_rpy(*(self.numbers.get(name, 0.0) for name in ("x", "y", "z", "roll", "pitch", "yaw")))


class SpawnModel:
    """Spawns one model and ends; with -b it stays, and takes the model away at its end."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Spawn; 1 where that fails, as in the original."""
        node = self._node
        try:
            request = _Request.read(self._arguments)
            if "-model" not in request.texts:
                raise UsageError("-model NAME is missing")
            gazebo = request.texts.get("-gazebo_namespace", "/gazebo").rstrip("/")
            await self._wait_for(request.texts.get("-wait"), gazebo)
            await self._spawn(request, gazebo)
        except (TrundleError, RosError) as error:
            node.log_error(f"spawn_model: {error}")
            return 1
        if request.flags & {"-b", "-bond"}:
            await self._stay(request.texts["-model"], gazebo)
        return 0

    async def _spawn(self, request: _Request, gazebo: str) -> None:
        node, texts = self._node, request.texts
        xml, kind = await self._model(request)
        if "-package_to_model" in request.flags:
            xml = xml.replace("package://", "model://")
        service = f"{gazebo}/spawn_{kind}_model"
        node.log_info(f"Waiting for service {service}")
        await node.wait_for_service(service, _TIMEOUT_S)
        answer = await node.call_service(
            service,
            "gazebo_msgs/SpawnModel",
            {
                "model_name": texts["-model"],
                "model_xml": xml,
                "robot_namespace": texts.get("-robot_namespace", node.resolve("x").rpartition("/")[0] or "/"),
                "initial_pose": pose_fields(request.pose),
                "reference_frame": texts.get("-reference_frame", ""),
            },
            timeout_s=_TIMEOUT_S,
        )
        _check(answer)
        node.log_info(f"Spawn status: {answer.status_message}")
        if request.joints:
            _check(
                await node.call_service(
                    f"{gazebo}/set_model_configuration",
                    "gazebo_msgs/SetModelConfiguration",
                    {
                        "model_name": texts["-model"],
                        "urdf_param_name": texts.get("-param", ""),
                        "joint_names": list(request.joints),
                        "joint_positions": list(request.joints.values()),
                    },
                    timeout_s=_TIMEOUT_S,
                )
            )
        if "-unpause" in request.flags:
            await node.call_service(f"{gazebo}/unpause_physics", "std_srvs/Empty")

    async def _model(self, request: _Request) -> tuple[str, Literal["urdf", "sdf"]]:
        """The model's text, and of which kind it is."""
        texts = request.texts
        sources = [source for source in ("-file", "-param", "-database") if source in texts]
        sources += ["-stdin"] if "-stdin" in request.flags else []
        if len(sources) != 1:
            raise UsageError(f"one of -file, -param, -database, -stdin is needed; got {' '.join(sources) or 'none'}")
        if request.kind is None and sources != ["-database"]:
            raise UsageError("one of -urdf, -sdf is needed")
        match sources[0]:
            case "-file":
                with self._node.loop.work.under_way():
                    xml = await asyncio.to_thread(_read, texts["-file"])
            case "-param":
                xml = await self._parameter(texts["-param"])
            case "-stdin":
                xml = await asyncio.to_thread(sys.stdin.read)
            case _:
                uri = f"model://{texts['-database']}"
                return f"<sdf version='1.6'><include><uri>{uri}</uri></include></sdf>", "sdf"
        return xml, request.kind or "sdf"

    async def _parameter(self, name: str) -> str:
        try:
            xml = await self._node.get_param(name)
        except ParameterError as error:
            raise UsageError(str(error)) from None
        if not isinstance(xml, str) or not xml.strip():
            raise UsageError(f"parameter {self._node.resolve(name)} holds no model")
        return xml

    async def _wait_for(self, model: str | None, gazebo: str) -> None:
        """Wait until another model is there."""
        if model is None:
            return
        found = asyncio.Event()

        def look(message: Message) -> None:
            if model in message.name:
                found.set()

        self._node.log_info(f"Waiting for model {model} before proceeding.")
        listening = self._node.subscribe(f"{gazebo}/model_states", "gazebo_msgs/ModelStates", look)
        await found.wait()
        listening.unregister()

    async def _stay(self, model: str, gazebo: str) -> None:
        self._node.log_info("Waiting for shutdown to delete the model")
        try:
            await self._node.closed.wait()
        finally:
            fields = {"model_name": model}
            await self._node.call_service(f"{gazebo}/delete_model", "gazebo_msgs/DeleteModel", fields, timeout_s=1.0)


def _check(answer: Message) -> None:
    if not answer.success:
        raise UsageError(answer.status_message)


def _read(file: str) -> str:
    try:
        return Path(file).read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise UsageError(f"-file {file}: {error.strerror}") from None

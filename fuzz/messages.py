"""Definitions of messages, services, actions and configurations, and serialized messages."""

import importlib
import json
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from trundle.ros import MessagePrinter, Messages
from trundle.ros.rospy import finder

from .seeds import seed
from .target import Execute, Open, Target, call_all

_WORDS = (
    b"float64[]", b"uint8[99999999999]", b"string[3]", b"pkg/Kind[] kinds", b"Kind kind", b"Header header", b"int32 A=",
    b"string S=", b"---", b"---\n---", b"geometry_msgs/PoseStamped", b"bool", b"char", b"duration", b"#", b"[-1]",
    b"[0]", b"==\nMSG: pkg/Kind\n", b"float32 X=1e99", b"uint8 Y=-1", b"const",
)  # fmt: skip
_TYPES = (
    "std_msgs/String", "sensor_msgs/PointCloud2", "sensor_msgs/JointState", "tf2_msgs/TFMessage",
    "nav_msgs/OccupancyGrid", "diagnostic_msgs/DiagnosticArray", "visualization_msgs/MarkerArray",
    "sensor_msgs/Image", "std_msgs/Float64MultiArray",
)  # fmt: skip


def _defines(kind: str, use: Callable[[Messages], object]) -> Open:
    """Return an `open` that reads a definition in a package's folder."""

    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        file = folder / "pkg" / kind / f"Kind.{kind}"
        file.parent.mkdir(parents=True)

        def execute(data: bytes) -> None:
            file.write_bytes(data)
            messages = Messages()
            messages.add_package("pkg", folder / "pkg")
            use(messages)

        yield execute

    return opened


def _use(messages: Messages, name: str) -> None:
    """Look a type up in all ways, and serialize and deserialize an empty message."""
    messages.md5(name)
    messages.definition(name)
    messages.text(name)
    messages.fields(name)
    messages.constants(name)
    empty = messages.serialize(messages.new(name))
    messages.deserialize(empty, name)


def _use_service(messages: Messages) -> None:
    service = messages.service("pkg/Kind")
    _use(messages, service.request)
    _use(messages, service.response)


@contextmanager
def _open_configuration(folder: Path) -> Generator[Execute]:
    """Run a .cfg file, which is Python: only the arguments of its calls are from the input, one list per line."""
    finder.install()
    reader: Any = importlib.import_module("dynamic_reconfigure.config_reader")
    file = folder / "Fuzz.cfg"

    def execute(data: bytes) -> None:
        lines = ["from dynamic_reconfigure.parameter_generator_catkin import *", "from math import inf, nan"]
        lines.append("gen = ParameterGenerator()")
        for line in data.decode(errors="replace").splitlines():
            try:
                arguments = json.loads(line)
            except (ValueError, RecursionError):
                continue
            if isinstance(arguments, list):
                lines.append(f"gen.add(*{arguments!r})")
        file.write_text("\n".join([*lines, "exit(gen.generate('p', 'n', 'Fuzz'))"]), errors="replace")
        try:
            json.dumps(reader.config_namespace("p", file)["config_description"], default=str)
        except ImportError:
            return

    yield execute


@contextmanager
def _open_definition(_: Path) -> Generator[Execute]:
    """Read a full definition, as in a connection header or a bag."""

    def execute(data: bytes) -> None:
        messages = Messages(bare=True)
        messages.add_definition("pkg/Kind", data.decode(errors="replace"))
        _use(messages, "pkg/Kind")

    yield execute


@contextmanager
def _open_serialized(_: Path) -> Generator[Execute]:
    """Deserialize an input as several types, print the message, and serialize it."""
    messages = Messages()
    printer = MessagePrinter(messages=messages)

    def read(data: bytes, name: str) -> None:
        message = messages.deserialize(data, name)
        printer.text(message, name)
        messages.serialize(message)

    def execute(data: bytes) -> None:
        call_all(*(lambda name=name: read(data, name) for name in _TYPES))

    yield execute


def _serialized() -> list[bytes]:
    messages = Messages()
    cloud = {
        "height": 1, "width": 2, "point_step": 12, "row_step": 24, "data": bytes(24),
        "fields": [{"name": "x", "offset": 0, "datatype": 7, "count": 1}],
    }  # fmt: skip
    values = {
        "std_msgs/String": {"data": "text"},
        "sensor_msgs/PointCloud2": cloud,
        "sensor_msgs/JointState": {"name": ["a", "b"], "position": [1.0, 2.0]},
        "nav_msgs/OccupancyGrid": {"info": {"width": 2, "height": 2}, "data": [0, 100, -1, 0]},
        "diagnostic_msgs/DiagnosticArray": {"status": [{"name": "n", "values": [{"key": "k", "value": "v"}]}]},
        "sensor_msgs/Image": {"height": 2, "width": 2, "encoding": "mono8", "step": 2, "data": bytes(4)},
        "tf2_msgs/TFMessage": {"transforms": [{"child_frame_id": "c"}, {}]},
        "std_msgs/Float64MultiArray": {"data": [1.0, 2.0]},
        "visualization_msgs/MarkerArray": {"markers": [{"points": [{}, {"x": 1.0}], "text": "t"}]},
    }
    return [bytes(messages.serialize(messages.new(name, fields))) for name, fields in values.items()]


TARGETS = {
    "msg": Target(
        open=_defines("msg", lambda messages: _use(messages, "pkg/Kind")),
        seeds=lambda: [seed("all.msg")],
        words=_WORDS,
    ),
    "srv": Target(open=_defines("srv", _use_service), seeds=lambda: [seed("all.srv")], words=_WORDS),
    "action": Target(
        open=_defines("action", lambda messages: _use(messages, "pkg/KindAction")),
        seeds=lambda: [seed("all.action")],
        words=_WORDS,
    ),
    "definition": Target(open=_open_definition, seeds=lambda: [seed("all.definition")], words=_WORDS),
    "cfg": Target(
        open=_open_configuration, seeds=lambda: [seed("options.cfg")], words=(b'"enum"', b"None", b"{}", b"[]")
    ),
    "message": Target(open=_open_serialized, seeds=_serialized),
}

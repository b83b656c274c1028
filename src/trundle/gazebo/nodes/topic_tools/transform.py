"""topic_tools/transform: computes a topic from another one with a Python expression."""

import asyncio
import importlib
from types import CodeType
from typing import Any

from trundle.ros import Message, MessageError, Node, RawMessage

from ..host import NodeHost

_USAGE = "usage: transform INPUT[/FIELD] OUTPUT TYPE EXPRESSION [--import MODULE…]; the message is m in the expression"

_POLL_S = 0.2


class Transform:
    """Evaluates an expression for each message; like any node of a launch file, this runs the user's code."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._names: dict[str, Any] = {}
        self._failed = False

    async def run(self) -> int:
        """Transform until cancelled."""
        node = self._node
        arguments = [word for word in self._arguments if word != "--wait-for-start"]
        modules = ["numpy"]
        if "--import" in arguments:
            index = arguments.index("--import")
            arguments, modules = arguments[:index], [*modules, *arguments[index + 1 :]]
        if len(arguments) != 4:
            node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 1
        source, target, type_name, text = arguments
        try:
            self._names = {name.partition(".")[0]: importlib.import_module(name) for name in modules}
            self._code = compile(text, "<expression>", "eval")
            self._output = node.advertise(target, type_name, queue_size=1)
        except (ImportError, SyntaxError, MessageError) as error:
            node.log.error(f"transform {text!r}: {error}")
            return 1
        self._source = node.resolve(source)
        await self._subscribe()
        await node.closed.wait()
        return 0

    async def _subscribe(self) -> None:
        """Wait for a topic that is a prefix of the input, the longest one; the rest is a field path."""
        parts = self._source.strip("/").split("/")
        prefixes = [(count, "/" + "/".join(parts[:count])) for count in range(len(parts), 0, -1)]
        call = self._node.master.call
        while True:
            topics = {str(name) for name, _ in await call("getTopicTypes")}
            call = self._node.master.poll
            for count, name in prefixes:
                if name in topics:
                    self._fields = parts[count:]
                    self._node.subscribe(name, "*", self._on_message, queue_size=1)
                    return
            await asyncio.sleep(_POLL_S)

    def _on_message(self, raw: RawMessage) -> None:
        node = self._node
        try:
            node.messages.add_definition(raw.type, raw.definition)
            value: Any = node.messages.deserialize(raw.data, raw.type)
            for name in self._fields:
                value = getattr(value, name)
            self._output.publish(self._message(_evaluate(self._code, {**self._names, "m": value})))
        except Exception as error:  # user code may raise anything
            if not self._failed:
                node.log.error(f"transform: {type(error).__name__}: {error}")
            self._failed = True

    def _message(self, value: Any) -> Message:
        """Return the message of the expression's result: a message, its fields in order, or its only field's value."""
        if hasattr(value, "__msgtype__"):
            return value
        if isinstance(value, list | tuple):
            return self._node.new(self._output.type, list(value))
        return self._node.new(self._output.type, [value])


def _evaluate(code: CodeType, names: dict[str, Any]) -> Any:
    return eval(code, names)

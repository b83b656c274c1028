"""dynamic_reconfigure client: find nodes with options, read and set them."""

import asyncio
import contextlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..errors import ServiceError
from ..messages.raw_message import Message
from ..node.graph_node import Node
from .reconfigure_server import Option, Options, OptionValue, config_message, config_values

if TYPE_CHECKING:
    from ..message_types import dynamic_reconfigure

_DESCRIPTIONS = "/parameter_descriptions"
_KIND = "dynamic_reconfigure"
_BOOLS = {"true": True, "1": True, "yes": True, "on": True, "false": False, "0": False, "no": False, "off": False}


async def find_reconfigurable(node: Node) -> list[str]:
    """Sorted names of nodes, and of namespaces within nodes, that have options."""
    topics = await node.master.call("getTopicTypes")
    kind = f"{_KIND}/ConfigDescription"
    return sorted(name.removesuffix(_DESCRIPTIONS) for name, type_ in topics if type_ == kind and _DESCRIPTIONS in name)


async def read_options(node: Node, name: str, *, timeout_s: float | None = None) -> list[Option]:
    """Read the options of a node with their current values.

    Raises:
        ServiceError: no answer in time.
    """
    space = node.resolve(name).rstrip("/")
    try:
        async with asyncio.timeout(timeout_s):
            description, config = await asyncio.gather(
                _latched_message(node, f"{space}{_DESCRIPTIONS}", f"{_KIND}/ConfigDescription"),
                _latched_message(node, f"{space}/parameter_updates", f"{_KIND}/Config"),
            )
    except TimeoutError:
        raise ServiceError(f"{space} sent no options within {timeout_s:g} s") from None
    lower, upper, values = config_values(description.min), config_values(description.max), config_values(config)
    parameters = [parameter for group in description.groups for parameter in group.parameters]
    return [_option(p, values[p.name], lower, upper) for p in parameters if p.name in values]


async def set_options(
    node: Node, name: str, values: Mapping[str, object], *, timeout_s: float | None = None
) -> Options:
    """Set options of a node; returns the resulting values of all.

    Raises:
        ServiceError: there is no such node or option, a value does not fit, or the node refuses.
    """
    options = {option.name: option for option in await read_options(node, name, timeout_s=timeout_s)}
    requested: Options = {}
    for key, value in values.items():
        if key not in options:
            raise ServiceError(f"don't know parameter: {key}; there are: {', '.join(options)}")
        requested[key] = _converted(key, value, type(options[key].value))
    service = f"{node.resolve(name).rstrip('/')}/set_parameters"
    answer = await node.call_service(service, f"{_KIND}/Reconfigure", {"config": config_message(requested)})
    return config_values(answer.config)


async def _latched_message(node: Node, topic: str, kind: str) -> Message:
    """Latched message of a topic."""
    future: asyncio.Future[Message] = asyncio.get_running_loop().create_future()

    def on_message(message: "dynamic_reconfigure.Config") -> None:
        if not future.done():
            future.set_result(message)

    subscription = node.subscribe(topic, kind, on_message, queue_size=1, on_loop=True)
    try:
        return await future
    finally:
        subscription.unregister()


def _option(parameter: Message, value: OptionValue, lower: Options, upper: Options) -> Option:
    bounds: dict[str, Any] = {}
    if isinstance(value, int | float) and not isinstance(value, bool):
        bounds = {"lower": float(lower[parameter.name]), "upper": float(upper[parameter.name])}
    return Option(name=parameter.name, value=value, description=parameter.description, **bounds)


def _converted(name: str, value: object, kind: type[OptionValue]) -> OptionValue:
    """Convert a value from text or YAML to the option's type."""
    if kind is bool and isinstance(value, str):
        value = _BOOLS.get(value.lower(), value)
    if kind is bool:
        if isinstance(value, bool | int):
            return bool(value)
    elif kind is str or isinstance(value, str | int | float):
        with contextlib.suppress(ValueError):
            return kind(str(value)) if kind is not float else float(str(value))
    raise ServiceError(f"option {name!r}: {value!r} is not of type {kind.__name__}")

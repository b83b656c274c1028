"""dynamic_reconfigure server: options of a node that can be set at run time."""

import contextlib
import math
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from ..errors import MasterUnreachableError
from ..node.callback_dispatch import run_on_callback_thread
from ..node.graph_node import Node

if TYPE_CHECKING:
    from ..message_types import dynamic_reconfigure

OptionValue: TypeAlias = bool | int | float | str
Options: TypeAlias = dict[str, OptionValue]
_FIELDS: dict[type[OptionValue], str] = {bool: "bools", int: "ints", float: "doubles", str: "strs"}
_TYPES: dict[type[OptionValue], str] = {bool: "bool", int: "int", float: "double", str: "str"}
_GROUP = "Default"


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """One option, of the type of its `value`."""

    name: str
    value: OptionValue
    """Initial and default value."""
    lower: float = -math.inf
    upper: float = math.inf
    description: str = ""

    def read(self, value: OptionValue) -> OptionValue | None:
        """Convert a value to this option's type and clamp it; None if the type does not fit."""
        kind = type(self.value)
        if kind is str or kind is bool:
            return value if type(value) is kind else None
        if isinstance(value, str) or not math.isfinite(value):
            return None
        return kind(min(max(value, self.lower), self.upper))


class ReconfigureServer:
    """Topics `parameter_descriptions` and `parameter_updates`, service `set_parameters`, and the parameters themselves.

    Clients: `dynparam`, rqt_reconfigure and `dynamic_reconfigure.client`, of ROS or Trundle.
    """

    def __init__(
        self, node: Node, options: Iterable[Option], apply: Callable[[Options], Options], *, namespace: str = "~"
    ) -> None:
        """Advertise the options; thread-safe.

        Args:
            node: node with the options.
            options: options in display order.
            apply: called with all values on the node's callback thread; returns the values in effect.
            namespace: namespace of topics, service and parameters: '~' or '/robot/camera'.
        """
        self._node = node
        self._options = {option.name: option for option in options}
        self._values: Options = {option.name: option.value for option in self._options.values()}
        self._apply = apply
        self._space = namespace if namespace == "~" else f"{namespace}/"
        kind = "dynamic_reconfigure"
        descriptions = node.advertise(f"{self._space}parameter_descriptions", f"{kind}/ConfigDescription", latch=True)
        self._updates = node.advertise(f"{self._space}parameter_updates", f"{kind}/Config", latch=True)
        self._endpoints = (
            descriptions,
            self._updates,
            node.advertise_service(f"{self._space}set_parameters", f"{kind}/Reconfigure", self._set),
        )
        descriptions.publish(self._description_message())
        self._updates.publish(config_message(self._values))
        node.loop.spawn(self._write(self._values))

    def unregister(self) -> None:
        """Unregister topics and service; thread-safe."""
        for endpoint in self._endpoints:
            endpoint.unregister()

    async def _set(self, request: "dynamic_reconfigure.ReconfigureRequest") -> dict[str, Any]:
        requested = {**self._values, **self._read(request.config)}
        node = self._node
        self._values = await run_on_callback_thread(node.deliver_call, node.loop, lambda: self._apply(requested))
        await self._write(self._values)
        self._updates.publish(config_message(self._values))
        return {"config": config_message(self._values)}

    def _read(self, config: "dynamic_reconfigure.Config") -> Options:
        """Requested values, clamped; unknown options and wrong types are logged."""
        values: Options = {}
        for item in (item for field in _FIELDS.values() for item in getattr(config, field)):
            option = self._options.get(item.name)
            value = None if option is None else option.read(item.value)
            if option is None:
                names = ", ".join(self._options)
                self._node.log.warn(f"no option {item.name!r} in {self._node.resolve(self._space)}; there are: {names}")
            elif value is None:
                kind = _TYPES[type(option.value)]
                self._node.log.warn(
                    f"option {item.name!r} is unchanged: {item.value!r} is not a finite value of type {kind}"
                )
            else:
                values[item.name] = value
        return values

    async def _write(self, values: Mapping[str, OptionValue]) -> None:
        with contextlib.suppress(MasterUnreachableError):  # the graph is ending
            for name, value in values.items():
                await self._node.params.set(f"{self._space}{name}", value)

    def _description_message(self) -> dict[str, Any]:
        options = self._options.values()
        parameters = [
            {"name": option.name, "type": _TYPES[type(option.value)], "description": option.description}
            for option in options
        ]
        return {
            "groups": [{"name": _GROUP, "parameters": parameters}],
            "min": config_message({option.name: _bound(option, option.lower) for option in options}),
            "max": config_message({option.name: _bound(option, option.upper) for option in options}),
            "dflt": config_message({option.name: option.value for option in options}),
        }


def _bound(option: Option, bound: float) -> OptionValue:
    """Bound in the option's own type, as clients expect."""
    match option.value:
        case bool():
            return bound > 0.0
        case str():
            return ""
        case int():
            return int(min(max(bound, -(2**31)), 2**31 - 1))
        case float():
            return min(max(bound, -sys.float_info.max), sys.float_info.max)


def config_message(values: Mapping[str, OptionValue]) -> dict[str, object]:
    """Fields of a dynamic_reconfigure/Config."""
    config: dict[str, Any] = {field: [] for field in _FIELDS.values()}
    for name, value in values.items():
        config[_FIELDS[type(value)]].append({"name": name, "value": value})
    return {**config, "groups": [{"name": _GROUP, "state": True}]}


def config_values(config: "dynamic_reconfigure.Config") -> Options:
    """Values in a dynamic_reconfigure/Config."""
    return {str(item.name): item.value for field in _FIELDS.values() for item in getattr(config, field)}

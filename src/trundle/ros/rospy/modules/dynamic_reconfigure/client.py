"""Client of another node's parameters."""

import ast
import sys
import threading
from collections.abc import Callable
from typing import Any

import rospy
from dynamic_reconfigure.msg import Config as ConfigMsg, ConfigDescription as ConfigDescrMsg
from dynamic_reconfigure.srv import Reconfigure as ReconfigureSrv

from . import DynamicReconfigureCallbackException, DynamicReconfigureParameterException
from .encoding import Config, decode_config, decode_description, encode_config, extract_params

_Type = type[int] | type[float] | type[str] | type[bool]
_TYPES: dict[str, _Type] = {"int": int, "double": float, "str": str, "bool": bool}
_TRUE = ("yes", "true", "t", "1")
_POLL_S = 0.2
"""Interval at which a wait checks for shutdown."""


class Client:
    """Reads and changes the parameters of a node that has a Server."""

    def __init__(
        self,
        name: str,
        timeout: float | None = None,
        config_callback: "Callable[[Any], object] | None" = None,
        description_callback: "Callable[[Any], object] | None" = None,
    ) -> None:
        """Wait for the server and connect.

        Args:
            name: node's name (with the Server's namespace).
            timeout: maximum wait [s]; None: no limit.
            config_callback: called with each new Config.
            description_callback: called with the list of parameters.

        Raises:
            rospy.ROSException: timeout.
        """
        self.name = name
        self.config: Config | None = None
        self.param_description: list[dict[str, Any]] | None = None
        self.group_description: Any = None
        self._param_types: dict[str, _Type] = {}
        self._cv = threading.Condition()
        self._config_callback = config_callback
        self._description_callback = description_callback
        self._set_service = self._get_service_proxy("set_parameters", timeout)
        self._descriptions_sub = self._subscribe("parameter_descriptions", ConfigDescrMsg, self._descriptions_msg)
        self._updates_sub = self._subscribe("parameter_updates", ConfigMsg, self._updates_msg)

    def get_configuration(self, timeout: float | None = None) -> "Config | None":
        """Latest Config; waits for the first one up to the timeout [s] (None: no limit), then returns None."""
        return self._wait_for("config", timeout)

    def get_parameter_descriptions(self, timeout: float | None = None) -> "list[dict[str, Any]] | None":
        """List of parameters; waits as `get_configuration` does."""
        return self._wait_for("param_description", timeout)

    def get_group_descriptions(self, timeout: float | None = None) -> Any:
        """Tree of groups; waits as `get_configuration` does."""
        return self._wait_for("group_description", timeout)

    def update_configuration(self, changes: "dict[str, Any]") -> "Config":
        """Change parameters; returns the server's new Config.

        Args:
            changes: name → value; strings are converted, also names of enumerated values; `groups`: name → state.

        Raises:
            DynamicReconfigureParameterException: no such parameter, or a value that does not fit its type.
            DynamicReconfigureCallbackException: the server failed.
        """
        descriptions = self.get_parameter_descriptions()
        if descriptions is not None:
            for name, value in list(changes.items()):
                if name != "groups":
                    changes[name] = self._convert(name, value, descriptions)
        if "groups" in changes:
            changes["groups"] = self.update_groups(changes["groups"])
        try:
            message = self._set_service(encode_config(changes)).config
        except rospy.ServiceException as error:
            raise DynamicReconfigureCallbackException(f"service call failed: {error}") from None
        return decode_config(message, self.get_group_descriptions())

    def update_groups(self, changes: dict[str, bool]) -> Any:
        """Tree of groups with changed states (name → state)."""
        tree = self.get_group_descriptions()

        def update(group: Any) -> None:
            for subgroup in group["groups"].values():
                subgroup["state"] = changes.get(subgroup["name"], subgroup["state"])
                update(subgroup)

        update(tree)
        return tree

    def close(self) -> None:
        """Disconnect."""
        self._descriptions_sub.unregister()
        self._updates_sub.unregister()

    def get_config_callback(self) -> "Callable[[Any], object] | None":
        """The function called with each Config."""
        return self._config_callback

    def set_config_callback(self, value: "Callable[[Any], object] | None") -> None:
        """Set the function called with each Config, and call it with the latest one."""
        self._config_callback = value
        if value is not None:
            value(self.config)

    config_callback = property(get_config_callback, set_config_callback)

    def get_description_callback(self) -> "Callable[[Any], object] | None":
        """The function called with the parameters."""
        return self._description_callback

    def set_description_callback(self, value: "Callable[[Any], object] | None") -> None:
        """Set the function called with the parameters, and call it with the latest ones."""
        self._description_callback = value
        if value is not None:
            value(self.param_description)

    description_callback = property(get_description_callback, set_description_callback)

    def _convert(self, name: str, value: Any, descriptions: list[dict[str, Any]]) -> Any:
        """Value in a parameter's type."""
        kind = self._param_types.get(name)
        if kind is None:
            raise DynamicReconfigureParameterException(f"don't know parameter: {name}")
        if kind is bool and isinstance(value, str):
            return value.lower() in _TRUE
        described = next(parameter for parameter in descriptions if parameter["name"] == name)
        if isinstance(value, str) and described["edit_method"]:
            for constant in ast.literal_eval(described["edit_method"])["enum"]:
                if value.lower() == constant["name"].lower():
                    return _TYPES[constant["type"]](constant["value"])
        try:
            return kind(value)
        except ValueError as error:
            raise DynamicReconfigureParameterException(f"can't set parameter '{name}' of {kind}: {error}") from None

    def _wait_for(self, attribute: str, timeout: float | None) -> Any:
        with self._cv:
            if timeout:
                self._cv.wait_for(lambda: getattr(self, attribute) is not None or rospy.is_shutdown(), timeout)
            else:
                while getattr(self, attribute) is None and not rospy.is_shutdown():
                    self._cv.wait(_POLL_S)
        return getattr(self, attribute)

    def _get_service_proxy(self, suffix: str, timeout: float | None) -> rospy.ServiceProxy:
        name = rospy.resolve_name(f"{self.name}/{suffix}")
        if not timeout:
            try:
                rospy.wait_for_service(name, 1.0)
            except rospy.ROSException:
                print(f"Waiting for service {name}...", file=sys.stderr)
                rospy.wait_for_service(name)
        else:
            rospy.wait_for_service(name, timeout)
        return rospy.ServiceProxy(name, ReconfigureSrv)

    def _subscribe(self, suffix: str, message_type: Any, callback: Callable[[Any], object]) -> rospy.Subscriber:
        return rospy.Subscriber(rospy.resolve_name(f"{self.name}/{suffix}"), message_type, callback=callback)

    def _updates_msg(self, msg: Any) -> None:
        description = self.get_group_descriptions()
        with self._cv:
            self.config = decode_config(msg, description)
            self._cv.notify_all()
        if self._config_callback is not None:
            self._config_callback(self.config)

    def _descriptions_msg(self, msg: Any) -> None:
        groups = decode_description(msg)
        parameters = extract_params(groups)
        with self._cv:
            self._param_types = {
                parameter["name"]: self._param_type_from_string(parameter["type"]) for parameter in parameters
            }
            self.group_description, self.param_description = groups, parameters
            self._cv.notify_all()
        if self._description_callback is not None:
            self._description_callback(parameters)

    def _param_type_from_string(self, type_str: str) -> _Type:
        if type_str not in _TYPES:
            raise DynamicReconfigureParameterException(f"the server has a parameter of the unknown type {type_str}")
        return _TYPES[type_str]

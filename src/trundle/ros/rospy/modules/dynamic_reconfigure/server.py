"""Server of a node's parameters."""

import copy
import threading
from collections.abc import Callable
from typing import Any

import rospy
from dynamic_reconfigure.msg import Config as ConfigMsg, ConfigDescription as ConfigDescrMsg
from dynamic_reconfigure.srv import Reconfigure as ReconfigureSrv

from . import DynamicReconfigureCallbackException
from .encoding import (
    decode_config,
    encode_config,
    encode_description,
    extract_params,
    get_tree,
    initial_config,
)

_EVERY_LEVEL = ~0


class Server:
    """Lets other nodes change parameters within their limits, and calls the node back."""

    def __init__(self, type: Any, callback: Callable[[Any, int], Any], namespace: str = "") -> None:
        """Read the parameters, and call the callback with them for the first time.

        Args:
            type: XConfig module.
            callback: called with the new Config and the level of the change (or of its bits); returns the Config,
                which it may have corrected.
            namespace: parameters' namespace, below the node's name.

        Raises:
            DynamicReconfigureCallbackException: the callback returned None.
        """
        self.mutex = threading.Lock()
        if namespace and namespace[0] not in "/~":
            namespace = f"~{namespace}"
        self.ns = f"{namespace}/".replace("//", "/") if namespace else "~"
        self.type = type
        self.callback = callback
        self.description = encode_description(type)
        self.config = type.defaults.copy()
        self._copy_from_parameter_server()
        self._clamp(self.config)
        self.config["groups"] = get_tree(self.description)
        self.config = initial_config(encode_config(self.config), type.config_description)
        self.descr_topic = rospy.Publisher(
            f"{self.ns}parameter_descriptions", ConfigDescrMsg, latch=True, queue_size=10
        )
        self.descr_topic.publish(self.description)
        self.update_topic = rospy.Publisher(f"{self.ns}parameter_updates", ConfigMsg, latch=True, queue_size=10)
        self._change_config(self.config, _EVERY_LEVEL)
        self.set_service = rospy.Service(f"{self.ns}set_parameters", ReconfigureSrv, self._set_callback)

    def update_configuration(self, changes: "dict[str, Any]") -> Any:
        """Change parameters from within the node; returns the new Config."""
        with self.mutex:
            config = copy.deepcopy(self.config)
            config.update(changes)
            self._clamp(config)
            return self._change_config(config, self._calc_level(config, self.config))

    def _parameters(self) -> list[dict[str, Any]]:
        return extract_params(self.type.config_description)

    def _copy_from_parameter_server(self) -> None:
        for parameter in self._parameters():
            name = parameter["name"]
            if rospy.has_param(self.ns + name):
                self.config[name] = rospy.get_param(self.ns + name)

    def _copy_to_parameter_server(self) -> None:
        for parameter in self._parameters():
            rospy.set_param(self.ns + parameter["name"], self.config[parameter["name"]])

    def _change_config(self, config: Any, level: int) -> Any:
        self.config = self.callback(config, level)
        if self.config is None:
            message = "Reconfigure callback should return a possibly updated configuration."
            rospy.logerr(message)
            raise DynamicReconfigureCallbackException(message)
        self._copy_to_parameter_server()
        self.update_topic.publish(encode_config(self.config))
        return self.config

    def _calc_level(self, config1: Any, config2: Any) -> int:
        level = 0
        for parameter in self._parameters():
            if config1[parameter["name"]] != config2[parameter["name"]]:
                level |= parameter["level"]
        return level

    def _clamp(self, config: Any) -> None:
        for parameter in self._parameters():
            name = parameter["name"]
            maximum, minimum = self.type.max[name], self.type.min[name]
            if maximum != "" and config[name] > maximum:
                config[name] = maximum
            elif minimum != "" and config[name] < minimum:
                config[name] = minimum

    def _set_callback(self, req: Any) -> Any:
        return encode_config(self.update_configuration(decode_config(req.config, self.type.config_description)))

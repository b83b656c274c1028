"""Server of a node's parameters."""

import copy
import threading

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
    """Lets others change parameters, within their limits, and calls the node back."""

    def __init__(self, type, callback, namespace=""):
        """Read the parameters, and call the callback with them for the first time.

        Args:
            type: XConfig module.
            callback: called with the new Config and the level of the change (or of its bits); returns the Config,
                possibly corrected.
            namespace: of the parameters, below the node's name.

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

    def update_configuration(self, changes):
        """Change parameters from within the node; returns the new Config."""
        with self.mutex:
            config = copy.deepcopy(self.config)
            config.update(changes)
            self._clamp(config)
            return self._change_config(config, self._calc_level(config, self.config))

    def _parameters(self):
        return extract_params(self.type.config_description)

    def _copy_from_parameter_server(self):
        for parameter in self._parameters():
            name = parameter["name"]
            if rospy.has_param(self.ns + name):
                self.config[name] = rospy.get_param(self.ns + name)

    def _copy_to_parameter_server(self):
        for parameter in self._parameters():
            rospy.set_param(self.ns + parameter["name"], self.config[parameter["name"]])

    def _change_config(self, config, level):
        self.config = self.callback(config, level)
        if self.config is None:
            message = "Reconfigure callback should return a possibly updated configuration."
            rospy.logerr(message)
            raise DynamicReconfigureCallbackException(message)
        self._copy_to_parameter_server()
        self.update_topic.publish(encode_config(self.config))
        return self.config

    def _calc_level(self, config1, config2):
        level = 0
        for parameter in self._parameters():
            if config1[parameter["name"]] != config2[parameter["name"]]:
                level |= parameter["level"]
        return level

    def _clamp(self, config):
        for parameter in self._parameters():
            name = parameter["name"]
            highest, lowest = self.type.max[name], self.type.min[name]
            if highest != "" and config[name] > highest:
                config[name] = highest
            elif lowest != "" and config[name] < lowest:
                config[name] = lowest

    def _set_callback(self, req):
        return encode_config(self.update_configuration(decode_config(req.config, self.type.config_description)))

"""Client of another node's parameters."""

import ast
import sys
import threading

import rospy
from dynamic_reconfigure.msg import Config as ConfigMsg, ConfigDescription as ConfigDescrMsg
from dynamic_reconfigure.srv import Reconfigure as ReconfigureSrv

from . import DynamicReconfigureCallbackException, DynamicReconfigureParameterException
from .encoding import decode_config, decode_description, encode_config, extract_params

_TYPES = {"int": int, "double": float, "str": str, "bool": bool}
_TRUE = ("yes", "true", "t", "1")
_POLL_S = 0.2
"""Interval at which a wait checks for shutdown."""


class Client:
    """Reads and changes the parameters of a node that has a Server."""

    def __init__(self, name, timeout=None, config_callback=None, description_callback=None):
        """Wait for the server and connect.

        Args:
            name: node's name (with the Server's namespace).
            timeout: longest wait [s]; None: no limit.
            config_callback: called with each new Config.
            description_callback: called with the list of parameters.

        Raises:
            rospy.ROSException: the server did not come in time.
        """
        self.name = name
        self.config = None
        self.param_description = None
        self.group_description = None
        self._param_types = None
        self._cv = threading.Condition()
        self._config_callback = config_callback
        self._description_callback = description_callback
        self._set_service = self._get_service_proxy("set_parameters", timeout)
        self._descriptions_sub = self._subscribe("parameter_descriptions", ConfigDescrMsg, self._descriptions_msg)
        self._updates_sub = self._subscribe("parameter_updates", ConfigMsg, self._updates_msg)

    def get_configuration(self, timeout=None):
        """Newest Config; waits for the first one, up to the timeout [s] (None: no limit), and returns None after."""
        return self._wait_for("config", timeout)

    def get_parameter_descriptions(self, timeout=None):
        """List of parameters; waits as `get_configuration` does."""
        return self._wait_for("param_description", timeout)

    def get_group_descriptions(self, timeout=None):
        """Tree of groups; waits as `get_configuration` does."""
        return self._wait_for("group_description", timeout)

    def update_configuration(self, changes):
        """Change parameters; returns the Config that the server now has.

        Args:
            changes: name → value; texts are converted, names of enumerated values too; `groups`: name → state.

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

    def update_groups(self, changes):
        """Tree of groups with other states (name → state)."""
        tree = self.get_group_descriptions()

        def update(group):
            for inner in group["groups"].values():
                inner["state"] = changes.get(inner["name"], inner["state"])
                update(inner)

        update(tree)
        return tree

    def close(self):
        """Disconnect."""
        self._descriptions_sub.unregister()
        self._updates_sub.unregister()

    def get_config_callback(self):
        """The function called with each Config."""
        return self._config_callback

    def set_config_callback(self, value):
        """Set that function, and call it with the newest Config."""
        self._config_callback = value
        if value is not None:
            value(self.config)

    config_callback = property(get_config_callback, set_config_callback)

    def get_description_callback(self):
        """The function called with the parameters."""
        return self._description_callback

    def set_description_callback(self, value):
        """Set that function, and call it with the newest description."""
        self._description_callback = value
        if value is not None:
            value(self.param_description)

    description_callback = property(get_description_callback, set_description_callback)

    def _convert(self, name, value, descriptions):
        """Value in a parameter's type."""
        kind = self._param_types.get(name)
        if kind is None:
            raise DynamicReconfigureParameterException(f"don't know parameter: {name}")
        if kind is bool and isinstance(value, str):
            return value.lower() in _TRUE
        described = next(each for each in descriptions if each["name"] == name)
        if isinstance(value, str) and described["edit_method"]:
            for constant in ast.literal_eval(described["edit_method"])["enum"]:
                if value.lower() == constant["name"].lower():
                    return _TYPES[constant["type"]](constant["value"])
        try:
            return kind(value)
        except ValueError as error:
            raise DynamicReconfigureParameterException(f"can't set parameter '{name}' of {kind}: {error}") from None

    def _wait_for(self, attribute, timeout):
        with self._cv:
            if timeout:
                self._cv.wait_for(lambda: getattr(self, attribute) is not None or rospy.is_shutdown(), timeout)
            else:
                while getattr(self, attribute) is None and not rospy.is_shutdown():
                    self._cv.wait(_POLL_S)
        return getattr(self, attribute)

    def _get_service_proxy(self, suffix, timeout):
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

    def _subscribe(self, suffix, message_type, callback):
        return rospy.Subscriber(rospy.resolve_name(f"{self.name}/{suffix}"), message_type, callback=callback)

    def _updates_msg(self, msg):
        description = self.get_group_descriptions()
        with self._cv:
            self.config = decode_config(msg, description)
            self._cv.notify_all()
        if self._config_callback is not None:
            self._config_callback(self.config)

    def _descriptions_msg(self, msg):
        groups = decode_description(msg)
        parameters = extract_params(groups)
        with self._cv:
            self._param_types = {each["name"]: self._param_type_from_string(each["type"]) for each in parameters}
            self.group_description, self.param_description = groups, parameters
            self._cv.notify_all()
        if self._description_callback is not None:
            self._description_callback(parameters)

    def _param_type_from_string(self, type_str):
        if type_str not in _TYPES:
            raise DynamicReconfigureParameterException(f"the server has a parameter of the unknown type {type_str}")
        return _TYPES[type_str]

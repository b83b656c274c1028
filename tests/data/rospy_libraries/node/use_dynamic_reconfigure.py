"""dynamic_reconfigure: server and client in one process; groups, clamping, enumerations, callbacks, errors."""

import threading
from types import SimpleNamespace

import dynamic_reconfigure
import dynamic_reconfigure.client
import dynamic_reconfigure.encoding
import dynamic_reconfigure.server
import rospy

ENUM = repr({"enum": [{"name": "Slow", "type": "int", "value": 1}, {"name": "Fast", "type": "int", "value": 5}]})


def parameter(name, kind, default, low, high, level, edit_method=""):
    """One parameter of a generated description."""
    return {
        "name": name, "type": kind, "default": default, "min": low, "max": high, "level": level,
        "description": f"the {name}", "edit_method": edit_method,
    }  # fmt: skip


INNER = {"name": "Inner", "type": "", "state": True, "id": 2, "parent": 1, "groups": [],
         "parameters": [parameter("deep", "double", 0.5, 0.0, 1.0, 8)]}  # fmt: skip
OUTER = {"name": "Outer", "type": "collapse", "state": False, "id": 1, "parent": 0, "groups": [INNER],
         "parameters": [parameter("mode", "int", 1, 0, 5, 4, ENUM)]}  # fmt: skip
TOP = [
    parameter("gain", "double", 2.0, -1.0, 3.0, 1),
    parameter("word", "str", "hello", "", "", 2),
    parameter("on", "bool", False, False, True, 2),
]
description = {"name": "Default", "type": "", "state": True, "id": 0, "parent": 0, "groups": [OUTER], "parameters": TOP}
everything = dynamic_reconfigure.encoding.extract_params(description)
config_type = SimpleNamespace(
    config_description=description,
    defaults={p["name"]: p["default"] for p in everything},
    min={p["name"]: p["min"] for p in everything},
    max={p["name"]: p["max"] for p in everything},
)


def plain(value):
    """Sorted content."""
    if isinstance(value, dict):
        return {key: plain(value[key]) for key in sorted(value)}
    return value


rospy.init_node("reconf")
if rospy.has_param("~"):
    rospy.delete_param("~")
rospy.set_param("~gain", 99.0)
calls = []


def on_change(config, level):
    """Note the change."""
    calls.append((round(config.gain, 3), config["word"], config.on, config.mode, config.deep, level))
    if config.word == "upper":
        config.word = "UPPER"
    return config


server = dynamic_reconfigure.server.Server(config_type, on_change)
print(calls)
print(rospy.get_param("~gain"), rospy.get_param("~word"), rospy.get_param("~deep"))
print(plain(server.config))
client = dynamic_reconfigure.client.Client("reconf", timeout=30)
print(plain(client.get_configuration(timeout=30)))
print(
    sorted(
        (p["name"], p["type"], p["level"], p["min"], p["max"], p["default"])
        for p in client.get_parameter_descriptions()
    )
)
print(plain(client.get_group_descriptions(30))["groups"]["Outer"]["type"])
print(plain(client.update_configuration({"gain": -7, "word": "upper", "on": "yes"})))
print(plain(client.update_configuration({"mode": "Fast", "deep": "0.25"})))
print(calls[1:])
got = threading.Event()
changes = []


def on_config(config):
    """Take what the topic brings."""
    changes.append(config and config["word"])
    if changes[-1] == "other":
        got.set()


client.config_callback = on_config
server.update_configuration({"word": "other", "gain": 1})
print(got.wait(30), changes[-1], rospy.get_param("~word"))
for bad in ({"nope": 1}, {"gain": "abc"}):
    try:
        client.update_configuration(bad)
    except dynamic_reconfigure.DynamicReconfigureParameterException as error:
        print(type(error).__name__)
named = dynamic_reconfigure.server.Server(config_type, lambda config, level: config, namespace="sub")
print(rospy.get_param("~sub/gain"))
try:
    dynamic_reconfigure.server.Server(config_type, lambda config, level: None, namespace="bad")
except dynamic_reconfigure.DynamicReconfigureCallbackException as error:
    print(error)
try:
    dynamic_reconfigure.client.Client("nobody", timeout=0.2)
except rospy.ROSException as error:
    print(type(error).__name__)
config = dynamic_reconfigure.encoding.Config(a=1)
config.b = 2
print(config.a, config["b"], sorted(config.copy()))
client.close()

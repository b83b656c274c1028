"""Configurations as dictionaries, from and to messages."""

import copy
from collections.abc import Iterable
from typing import Any

from dynamic_reconfigure.msg import (
    BoolParameter,
    Config as ConfigMsg,
    ConfigDescription as ConfigDescrMsg,
    DoubleParameter,
    Group as GroupMsg,
    GroupState,
    IntParameter,
    ParamDescription,
    StrParameter,
)


class Config(dict[str, Any]):
    """Dictionary whose items are attributes too."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def copy(self) -> "Config":
        """Shallow copy."""
        return Config(self)

    def __deepcopy__(self, memo: object) -> "Config":
        return type(self)({copy.deepcopy(key): copy.deepcopy(value) for key, value in self.items()})


def encode_description(descr: Any) -> Any:
    """ConfigDescription message of an XConfig module."""
    return ConfigDescrMsg(
        max=encode_config(descr.max),
        min=encode_config(descr.min),
        dflt=encode_config(descr.defaults),
        groups=encode_groups(None, descr.config_description),
    )


def encode_groups(parent: Any, group: Any) -> list[Any]:
    """Group messages of a description and its subgroups."""
    message = GroupMsg(name=group["name"], id=group["id"], parent=group["parent"], type=group["type"])
    message.parameters = [
        ParamDescription(*(parameter[field] for field in ("name", "type", "level", "description", "edit_method")))
        for parameter in group["parameters"]
    ]
    return [message, *(encoded for subgroup in group["groups"] for encoded in encode_groups(message, subgroup))]


def encode_config(config: dict[str, Any], flat: bool = True) -> Any:
    """Config message of a dictionary; the item `groups` is a tree, or with `flat=False` a list of groups."""
    message = ConfigMsg()
    for name, value in config.items():
        if isinstance(value, bool):
            message.bools.append(BoolParameter(name, value))
        elif isinstance(value, int):
            message.ints.append(IntParameter(name, value))
        elif isinstance(value, str):
            message.strs.append(StrParameter(name, value))
        elif isinstance(value, float):
            message.doubles.append(DoubleParameter(name, value))
        elif isinstance(value, dict):
            message.groups += [_group_state(value), *_subgroup_states(value)] if flat else map(_group_state, value)
    return message


def _group_state(group: dict[str, Any]) -> Any:
    return GroupState(group["name"], group["state"], group["id"], group["parent"])


def _subgroup_states(group: dict[str, Any]) -> list[Any]:
    """States of a group's subgroups, the innermost first."""
    states: list[Any] = []
    for subgroup in group["groups"].values():
        states += [*_subgroup_states(subgroup), _group_state(subgroup)]
    return states


def group_dict(group: Any) -> Config:
    """Config of a Group or GroupState message, without parameters and subgroups."""
    return Config(
        id=group.id,
        parent=group.parent,
        name=group.name,
        type=getattr(group, "type", ""),
        state=getattr(group, "state", True),
        groups=Config(),
        parameters=Config(),
    )


def decode_description(msg: Any) -> Config:
    """Tree of groups of a ConfigDescription message, each with the list of its parameters."""
    minima, maxima, defaults = (decode_config(part) for part in (msg.min, msg.max, msg.dflt))
    parameters = {
        group.id: [
            {
                "name": parameter.name,
                "min": minima[parameter.name],
                "max": maxima[parameter.name],
                "default": defaults[parameter.name],
                "type": parameter.type,
                "level": parameter.level,
                "description": parameter.description,
                "edit_method": parameter.edit_method,
            }
            for parameter in group.parameters
        ]
        for group in msg.groups
    }

    def fill(group: Config) -> Config:
        group["parameters"] = parameters[group["id"]]
        for subgroup in group["groups"].values():
            fill(subgroup)
        return group

    return fill(get_tree(msg))


def get_tree(m: Any, group: Any = None) -> Config:
    """Tree of the groups of a Config or ConfigDescription message; with `group` its subgroups by name."""
    root = group or next((message for message in m.groups if message.id == 0), None)
    if root is None:
        return Config()
    children = Config()
    for message in m.groups:
        if message.id != 0 and message.parent == root.id:
            children[message.name] = group_dict(message)
            children[message.name]["groups"] = get_tree(m, message)
    if root.id != 0:
        return children
    tree = group_dict(root)
    tree["groups"] = children
    return tree


def initial_config(msg: Any, description: Any = None) -> Config:
    """Config of a message, whose groups have the description's states and their parameters."""
    config = _values(msg)
    if not msg.groups or description is None:
        return config
    config["groups"] = get_tree(msg)

    def fill(group: Any, described: Any) -> None:
        for parameter in described["parameters"]:
            group["parameters"][parameter["name"]] = config[parameter["name"]]
        for subgroup in described["groups"]:
            if subgroup["name"] in group["groups"]:
                group["groups"][subgroup["name"]]["state"] = subgroup["state"]
                fill(group["groups"][subgroup["name"]], subgroup)

    fill(config["groups"], description)
    return config


def decode_config(msg: Any, description: Any = None) -> Config:
    """Config of a message; with a description its item `groups` is a tree of groups with their parameters."""
    config = _values(msg)
    if not msg.groups or description is None:
        return config
    config["groups"] = get_tree(msg)

    def fill(group: Any, described: Any) -> None:
        for parameter in described["parameters"]:
            if parameter["name"] in config:
                group[parameter["name"]] = config[parameter["name"]]
        for subgroup in _subgroups(described):
            if subgroup["name"] in group["groups"]:
                fill(group["groups"][subgroup["name"]], subgroup)

    fill(config["groups"], description)
    return config


def extract_params(group: Any) -> list[dict[str, Any]]:
    """Parameters of a described group and of all its subgroups."""
    return [
        *group["parameters"],
        *(parameter for subgroup in _subgroups(group) for parameter in extract_params(subgroup)),
    ]


def get_parents(group: Any, descriptions: Any) -> list[Any]:
    """Ancestors of a group, the outermost first."""
    return [
        ancestor
        for parent in descriptions["group"]
        if parent["id"] == group["parent"]
        for ancestor in (*get_parents(parent, descriptions), parent)
    ]


def _subgroups(group: Any) -> Iterable[Any]:
    """Subgroups of a group: a list if it was generated, a dictionary if it was decoded from a message."""
    groups = group["groups"]
    return groups.values() if isinstance(groups, dict) else groups


def _values(msg: Any) -> Config:
    return Config((parameter.name, parameter.value) for parameter in (*msg.bools, *msg.ints, *msg.strs, *msg.doubles))

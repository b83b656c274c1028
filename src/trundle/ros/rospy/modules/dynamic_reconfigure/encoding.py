"""Configurations as dictionaries, from and to messages."""

import copy

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


class Config(dict):
    """Dictionary whose items are attributes too."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name, value):
        self[name] = value

    def copy(self):
        """Shallow copy."""
        return Config(self)

    def __deepcopy__(self, memo):
        return type(self)({copy.deepcopy(key): copy.deepcopy(value) for key, value in self.items()})


def encode_description(descr):
    """ConfigDescription message of an XConfig module."""
    return ConfigDescrMsg(
        max=encode_config(descr.max),
        min=encode_config(descr.min),
        dflt=encode_config(descr.defaults),
        groups=encode_groups(None, descr.config_description),
    )


def encode_groups(parent, group):
    """Group messages of a description and its subgroups."""
    message = GroupMsg(name=group["name"], id=group["id"], parent=group["parent"], type=group["type"])
    message.parameters = [
        ParamDescription(each["name"], each["type"], each["level"], each["description"], each["edit_method"])
        for each in group["parameters"]
    ]
    return [message, *(inner for child in group["groups"] for inner in encode_groups(message, child))]


def encode_config(config, flat=True):
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
            message.groups += [_group_state(value), *_inner_states(value)] if flat else map(_group_state, value)
    return message


def _group_state(group):
    return GroupState(group["name"], group["state"], group["id"], group["parent"])


def _inner_states(group):
    """States of the groups inside one, the innermost first."""
    states = []
    for inner in group["groups"].values():
        states += [*_inner_states(inner), _group_state(inner)]
    return states


def group_dict(group):
    """Config of a Group or GroupState message, without content."""
    return Config(
        id=group.id,
        parent=group.parent,
        name=group.name,
        type=getattr(group, "type", ""),
        state=getattr(group, "state", True),
        groups=Config(),
        parameters=Config(),
    )


def decode_description(msg):
    """Tree of groups of a ConfigDescription message, each with the list of its parameters."""
    lowest, highest, defaults = (decode_config(part) for part in (msg.min, msg.max, msg.dflt))
    parameters = {
        group.id: [
            {
                "name": each.name,
                "min": lowest[each.name],
                "max": highest[each.name],
                "default": defaults[each.name],
                "type": each.type,
                "level": each.level,
                "description": each.description,
                "edit_method": each.edit_method,
            }
            for each in group.parameters
        ]
        for group in msg.groups
    }

    def fill(group):
        group["parameters"] = parameters[group["id"]]
        for inner in group["groups"].values():
            fill(inner)
        return group

    return fill(get_tree(msg))


def get_tree(m, group=None):
    """Tree of the groups of a Config or ConfigDescription message; below `group` only: its subgroups by name."""
    root = group or next((each for each in m.groups if each.id == 0), None)
    if root is None:
        return Config()
    children = Config()
    for each in m.groups:
        if each.id != 0 and each.parent == root.id:
            children[each.name] = group_dict(each)
            children[each.name]["groups"] = get_tree(m, each)
    if root.id != 0:
        return children
    tree = group_dict(root)
    tree["groups"] = children
    return tree


def initial_config(msg, description=None):
    """Config of a message, where groups are in the state of the description and carry their parameters."""
    config = _values(msg)
    if not msg.groups or description is None:
        return config
    config["groups"] = get_tree(msg)

    def fill(group, described):
        for parameter in described["parameters"]:
            group["parameters"][parameter["name"]] = config[parameter["name"]]
        for inner in described["groups"]:
            if inner["name"] in group["groups"]:
                group["groups"][inner["name"]]["state"] = inner["state"]
                fill(group["groups"][inner["name"]], inner)

    fill(config["groups"], description)
    return config


def decode_config(msg, description=None):
    """Config of a message; with a description its item `groups` is a tree, whose groups have their parameters."""
    config = _values(msg)
    if not msg.groups or description is None:
        return config
    config["groups"] = get_tree(msg)

    def fill(group, described):
        for parameter in described["parameters"]:
            if parameter["name"] in config:
                group[parameter["name"]] = config[parameter["name"]]
        for inner in _children(described):
            if inner["name"] in group["groups"]:
                fill(group["groups"][inner["name"]], inner)

    fill(config["groups"], description)
    return config


def extract_params(group):
    """Parameters of a described group and of all groups inside."""
    return [*group["parameters"], *(each for inner in _children(group) for each in extract_params(inner))]


def get_parents(group, descriptions):
    """Groups around a group, the outermost first."""
    return [
        each
        for parent in descriptions["group"]
        if parent["id"] == group["parent"]
        for each in (*get_parents(parent, descriptions), parent)
    ]


def _children(group):
    """Groups inside a group: a list where it was generated, a dictionary where it came in a message."""
    groups = group["groups"]
    return groups.values() if isinstance(groups, dict) else groups


def _values(msg):
    return Config((each.name, each.value) for each in (*msg.bools, *msg.ints, *msg.strs, *msg.doubles))

"""Generator that .cfg files describe a node's parameters with.

`generate` only hands the description over: `dynamic_reconfigure.config_reader` makes the module XConfig of it when a
program imports that, so nothing is built.
"""

import inspect
import itertools
import re
import sys

str_t = "str"
bool_t = "bool"
int_t = "int"
double_t = "double"

__all__ = ["ParameterGenerator", "bool_t", "check_description", "check_name", "double_t", "int_t", "str_t"]

_PYTHON = {"str": str, "int": int, "double": float, "bool": bool}
_C = {"str": "std::string", "int": "int", "double": "double", "bool": "bool"}
_NAME = re.compile(r"[a-zA-Z][a-zA-Z0-9_]*")

collected = []
"""Generators whose `generate` was called, since a reader emptied it."""


def check_description(description):
    """Check a description, which is quoted in generated code.

    Raises:
        ValueError: it has quotes.
    """
    if '"' in description or "'" in description:
        raise ValueError(f"quotes are not allowed in a description: {description}")


def check_name(name):
    """Check a parameter's name.

    Raises:
        ValueError: it is not made of letters, digits and underscores.
    """
    if not _NAME.fullmatch(name):
        raise ValueError(f"'{name}' is no name of a parameter: use letters, digits and _, and begin with a letter")


class ParameterGenerator:
    """Parameters, constants and groups of one configuration."""

    minval = {"int": -0x80000000, "double": -float("inf"), "str": "", "bool": False}
    maxval = {"int": 0x7FFFFFFF, "double": float("inf"), "str": "", "bool": True}
    defval = {"int": 0, "double": 0.0, "str": "", "bool": False}

    class Group:
        """Parameters that are shown together."""

        def __init__(self, gen, name, type, state, id, parent):
            self.gen = gen
            self.name = name.replace(" ", "_")
            self.type = type
            self.state = state
            self.id = id
            self.parent = parent
            self.groups = []
            self.parameters = []

        def add_group(self, name, type="", state=True):
            """Add a group inside this one, and return it.

            Args:
                name: of the group.
                type: how rqt_reconfigure shows it: "", "tab", "collapse", "hide", "apply".
                state: open or not.
            """
            group = self.gen.Group(self.gen, name, type, state, next(self.gen.group_ids), self.id)
            self.groups.append(group)
            return group

        def add(self, name, paramtype, level, description, default=None, min=None, max=None, edit_method=""):
            """Add a parameter; see `ParameterGenerator.add`."""
            check_name(name)
            check_description(description)
            parameter = {
                "name": name,
                "type": paramtype,
                "default": default,
                "level": level,
                "description": description,
                "min": min,
                "max": max,
                "edit_method": edit_method,
                **_place(),
                **_c_types(paramtype),
            }
            for field, values in (("default", self.gen.defval), ("max", self.gen.maxval), ("min", self.gen.minval)):
                if parameter[field] is None:
                    parameter[field] = values[paramtype]
                else:
                    _check_type(parameter, field)
            self.parameters.append(parameter)

        def get_parameters(self):
            """Parameters of this group and those inside."""
            return [*self.parameters, *(each for group in self.groups for each in group.get_parameters())]

        def to_dict(self):
            """Description, as `config_description` has it."""
            return {
                "name": self.name,
                "type": self.type,
                "state": self.state,
                "cstate": "true" if self.state else "false",
                "id": self.id,
                "parent": self.parent,
                "parameters": self.parameters,
                "groups": [group.to_dict() for group in self.groups],
            }

    def __init__(self):
        self.group_ids = itertools.count(1)
        self.group = self.Group(self, "Default", "", True, 0, 0)
        self.constants = []
        self.name = ""

    def const(self, name, type, value, descr):
        """Constant, for `enum`."""
        check_description(descr)
        constant = {"name": name, "type": type, "value": value, **_place(), "description": descr, **_c_types(type)}
        _check_type(constant, "value")
        self.constants.append(constant)
        return constant

    def enum(self, constants, description):
        """`edit_method` of a parameter whose values have names.

        Raises:
            ValueError: the constants differ in type.
        """
        if len({constant["type"] for constant in constants}) != 1:
            raise ValueError(f"the constants of '{description}' must be of one type")
        check_description(description)
        return repr({"enum": constants, "enum_description": description})

    def add(self, name, paramtype, level, description, default=None, min=None, max=None, edit_method=""):
        """Add a parameter.

        Args:
            name: of the parameter.
            paramtype: int_t, double_t, str_t or bool_t.
            level: bits that the server's callback gets when it changes.
            description: one sentence.
            default: value at first.
            min: lowest value.
            max: highest value.
            edit_method: of `enum`.
        """
        self.group.add(name, paramtype, level, description, default, min, max, edit_method)

    def add_group(self, name, type="", state=True):
        """Add a group, and return it; see `Group.add_group`."""
        return self.group.add_group(name, type=type, state=state)

    def generate(self, pkgname, nodename, name):
        """Hand the description over to programs that import `pkgname.cfg.nameConfig`; returns 0, for exit()."""
        self.pkgname, self.nodename, self.name = pkgname, nodename, name
        collected.append(self)
        return 0


def _check_type(parameter, field):
    kind, value = _PYTHON[parameter["type"]], parameter[field]
    if type(value) is not kind and not (kind is float and type(value) is int):
        raise TypeError(f"'{parameter['name']}' has type {parameter['type']}, but {field} is {value!r}")
    parameter[field] = kind(value)


def _c_types(kind):
    return {"ctype": _C[kind], "cconsttype": "const char * const" if kind == "str" else f"const {_C[kind]}"}


def _place():
    """File and line of the .cfg that calls."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename == __file__:
        frame = frame.f_back
    return {"srcline": frame.f_lineno, "srcfile": inspect.getfile(frame)}

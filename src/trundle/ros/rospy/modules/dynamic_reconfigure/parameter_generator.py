"""Generator by which .cfg files describe a node's parameters.

`generate` only collects the description: `dynamic_reconfigure.config_reader` creates the module XConfig from it when a
program imports that, without a build.
"""

import inspect
import itertools
import re
import sys

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this module's
if TYPE_CHECKING:
    from typing import Any

str_t = "str"
bool_t = "bool"
int_t = "int"
double_t = "double"

__all__ = ["ParameterGenerator", "bool_t", "check_description", "check_name", "double_t", "int_t", "str_t"]

_PYTHON = {"str": str, "int": int, "double": float, "bool": bool}
_C = {"str": "std::string", "int": "int", "double": "double", "bool": "bool"}
_NAME = re.compile(r"[a-zA-Z][a-zA-Z0-9_]*")

collected: "list[ParameterGenerator]" = []
"""Generators whose `generate` was called since a reader cleared the list."""


def check_description(description: str) -> None:
    """Check a description, which generated code contains in quotes.

    Raises:
        ValueError: it has quotes.
    """
    if '"' in description or "'" in description:
        raise ValueError(f"quotes are not allowed in a description: {description}")


def check_name(name: str) -> None:
    """Check a parameter's name.

    Raises:
        ValueError: it has other characters than letters, digits and underscores.
    """
    if not _NAME.fullmatch(name):
        raise ValueError(f"'{name}' is not a parameter's name: use letters, digits and _, and begin with a letter")


class ParameterGenerator:
    """Parameters, constants and groups of one configuration."""

    minval = {"int": -0x80000000, "double": -float("inf"), "str": "", "bool": False}
    maxval = {"int": 0x7FFFFFFF, "double": float("inf"), "str": "", "bool": True}
    defval = {"int": 0, "double": 0.0, "str": "", "bool": False}

    class Group:
        """Group of parameters that are shown together."""

        def __init__(self, gen: "ParameterGenerator", name: str, type: str, state: bool, id: int, parent: int) -> None:
            self.gen = gen
            self.name = name.replace(" ", "_")
            self.type = type
            self.state = state
            self.id = id
            self.parent = parent
            self.groups: list[ParameterGenerator.Group] = []
            self.parameters: list[dict[str, Any]] = []

        def add_group(self, name: str, type: str = "", state: bool = True) -> "ParameterGenerator.Group":
            """Add a group inside this one, and return it.

            Args:
                name: group's name.
                type: display in rqt_reconfigure: "", "tab", "collapse", "hide", "apply".
                state: open or not.
            """
            group = self.gen.Group(self.gen, name, type, state, next(self.gen.group_ids), self.id)
            self.groups.append(group)
            return group

        def add(
            self,
            name: str,
            paramtype: str,
            level: int,
            description: str,
            default: "Any" = None,
            min: "Any" = None,
            max: "Any" = None,
            edit_method: str = "",
        ) -> None:
            """Add a parameter; see `ParameterGenerator.add`."""
            check_name(name)
            parameter: dict[str, Any] = {
                "name": name,
                "type": paramtype,
                "default": default,
                "level": level,
                "description": description,
                "min": min,
                "max": max,
                "edit_method": edit_method,
                **_source_location(),
                **_c_types(paramtype),
            }
            for field, values in (("default", self.gen.defval), ("max", self.gen.maxval), ("min", self.gen.minval)):
                if parameter[field] is None:
                    parameter[field] = values[paramtype]
                else:
                    _check_type(parameter, field)
            self.parameters.append(parameter)

        def get_parameters(self) -> "list[dict[str, Any]]":
            """Parameters of this group and its subgroups."""
            return [*self.parameters, *(parameter for group in self.groups for parameter in group.get_parameters())]

        def to_dict(self) -> "dict[str, Any]":
            """Description, as in `config_description`."""
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

    def __init__(self) -> None:
        self.group_ids = itertools.count(1)
        self.group = self.Group(self, "Default", "", True, 0, 0)
        self.constants: list[dict[str, Any]] = []
        self.name = ""

    def const(self, name: str, type: str, value: "Any", descr: str) -> "dict[str, Any]":
        """Constant, for `enum`."""
        check_description(descr)
        constant: dict[str, Any] = {
            "name": name,
            "type": type,
            "value": value,
            **_source_location(),
            "description": descr,
            **_c_types(type),
        }
        _check_type(constant, "value")
        self.constants.append(constant)
        return constant

    def enum(self, constants: "list[dict[str, Any]]", description: str) -> str:
        """`edit_method` of a parameter with named values.

        Raises:
            ValueError: the constants differ in type.
        """
        if len({constant["type"] for constant in constants}) != 1:
            raise ValueError(f"the constants of '{description}' must be of one type")
        check_description(description)
        return repr({"enum": constants, "enum_description": description})

    def add(
        self,
        name: str,
        paramtype: str,
        level: int,
        description: str,
        default: "Any" = None,
        min: "Any" = None,
        max: "Any" = None,
        edit_method: str = "",
    ) -> None:
        """Add a parameter.

        Args:
            name: parameter's name.
            paramtype: int_t, double_t, str_t or bool_t.
            level: bits passed to the server's callback when the parameter changes.
            description: one sentence.
            default: initial value.
            min: minimum value.
            max: maximum value.
            edit_method: result of `enum`.
        """
        self.group.add(name, paramtype, level, description, default, min, max, edit_method)

    def add_group(self, name: str, type: str = "", state: bool = True) -> "ParameterGenerator.Group":
        """Add a group, and return it; see `Group.add_group`."""
        return self.group.add_group(name, type=type, state=state)

    def generate(self, pkgname: str, nodename: str, name: str) -> int:
        """Publish the description for programs that import `pkgname.cfg.nameConfig`; returns 0, for exit()."""
        self.pkgname, self.nodename, self.name = pkgname, nodename, name
        collected.append(self)
        return 0


def _check_type(parameter: "dict[str, Any]", field: str) -> None:
    kind, value = _PYTHON[parameter["type"]], parameter[field]
    if type(value) is not kind and not (kind is float and type(value) is int):
        raise TypeError(f"'{parameter['name']}' has type {parameter['type']}, but {field} is {value!r}")
    parameter[field] = kind(value)


def _c_types(kind: str) -> dict[str, str]:
    return {"ctype": _C[kind], "cconsttype": "const char * const" if kind == "str" else f"const {_C[kind]}"}


def _source_location() -> "dict[str, Any]":
    """File and line of the calling .cfg file."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename == __file__:
        frame = frame.f_back
    return {"srcline": frame.f_lineno, "srcfile": inspect.getfile(frame)}

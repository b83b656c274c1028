"""C++ headers of dynamic_reconfigure's configurations, from what .cfg files describe."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from .message_header import literal

_TYPES = {"str": "std::string", "int": "int", "double": "double", "bool": "bool"}
_CONSTANTS = {**_TYPES, "str": "char* const"}


def config_header(package: str, description: Mapping[str, Any]) -> str:
    """Return the header of a configuration.

    Args:
        package: name that the .cfg file gives for its package, which is the class's namespace.
        description: `name`, `group` (its parameters and groups, as in config_description) and `constants`.
    """
    cls = f"{description['name']}Config"
    groups = list(_groups(description["group"]))
    parameters = [(group["id"], parameter) for group in groups for parameter in group["parameters"]]
    fields = "".join(f"  {_TYPES[p['type']]} {p['name']} = {_value(p, p['default'])};\n" for _, p in parameters)
    rows = "".join(
        f"        {{{literal(p['name'])}, {p['level'] & 0xFFFFFFFF}u, {literal(p['description'])},\n"
        f"         {literal(p['edit_method'])}, {number}, &{cls}::{p['name']}}},\n"
        for number, p in parameters
    )
    states = "".join(
        f"        {{{literal(group['name'])}, {literal(group['type'])}, {group['parent']}, {group['id']},\n"
        f"         [](const {cls}& c) {{ return c.{path}.state; }},\n"
        f"         []({cls}& c, bool state) {{ c.{path}.state = state; }}}},\n"
        for group, path in _with_paths(description["group"], "groups")
    )
    constants = "".join(
        f"const {_CONSTANTS[c['type']]} {description['name']}_{c['name']} = {_value(c, c['value'])};\n"
        for c in description["constants"]
    )
    return f"""// Made from a .cfg file by Trundle; changes are lost.
#pragma once

#include <dynamic_reconfigure/config.h>

namespace {package} {{

class {cls} : public dynamic_reconfigure::ConfigBase<{cls}> {{
 public:
{_group_class(description["group"], "groups", "  ")}
{fields}
  {cls}() {{}}

  static const std::vector<dynamic_reconfigure::Parameter<{cls}> >& __parameters__() {{
    static const std::vector<dynamic_reconfigure::Parameter<{cls}> > table{{
{rows}    }};
    return table;
  }}
  static const std::vector<dynamic_reconfigure::GroupOf<{cls}> >& __groups__() {{
    static const std::vector<dynamic_reconfigure::GroupOf<{cls}> > table{{
{states}    }};
    return table;
  }}
  static const {cls}& __getDefault__() {{
    static const {cls} config;
    return config;
  }}
{_bound(cls, parameters, "min")}{_bound(cls, parameters, "max")}}};

{constants}
}}  // namespace {package}
"""


def _groups(group: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    yield group
    for child in group["groups"]:
        yield from _groups(child)


def _with_paths(group: Mapping[str, Any], path: str) -> Iterator[tuple[Mapping[str, Any], str]]:
    yield group, path
    for child in group["groups"]:
        yield from _with_paths(child, f"{path}.{child['name'].lower()}")


def _group_class(group: Mapping[str, Any], field: str, indent: str) -> str:
    inner = "".join(_group_class(child, child["name"].lower(), f"{indent}  ") for child in group["groups"])
    members = (
        f"{indent}  bool state = {'true' if group['state'] else 'false'};\n"
        f"{indent}  std::string name = {literal(group['name'])};\n"
    )
    return f"{indent}struct {group['name'].upper()} {{\n{inner}{members}{indent}}} {field};\n"


def _bound(cls: str, parameters: list[tuple[int, Mapping[str, Any]]], which: str) -> str:
    values = "".join(f"      c.{p['name']} = {_value(p, p[which])};\n" for _, p in parameters)
    return f"""  static const {cls}& __get{which.capitalize()}__() {{
    static const {cls} config = [] {{
      {cls} c;
{values}      return c;
    }}();
    return config;
  }}
"""


def _value(parameter: Mapping[str, Any], value: Any) -> str:
    """Return a literal of a parameter's or constant's type."""
    match parameter["type"]:
        case "str":
            return literal(value)
        case "bool":
            return "true" if value else "false"
        case "int":
            return "-2147483647 - 1" if value <= -(2**31) else str(min(value, 2**31 - 1))
        case _:
            if math.isinf(value):
                return f"{'-' if value < 0 else ''}__builtin_inf()"
            return '__builtin_nan("")' if math.isnan(value) else repr(float(value))

"""C++ headers of messages and services, with gencpp's names."""

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple, Protocol

from ..messages.raw_message import ServiceType

_NUMBERS = {
    "bool": "uint8_t",
    "byte": "int8_t",
    "char": "uint8_t",
    "float32": "float",
    "float64": "double",
    **{f"{sign}int{bits}": f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)},
}
_TIMES = {"time": "ros::Time", "duration": "ros::Duration"}
_ARRAY = re.compile(r"(?P<element>[^\[]+)(?:\[(?P<count>\d*)\])?")
_ALLOCATED = "typename std::allocator_traits<ContainerAllocator>::template rebind_alloc"
_STRING = f"std::basic_string<char, std::char_traits<char>, {_ALLOCATED}<char> >"
_SUFFIXES = {"uint64": "ULL", "int64": "LL", "uint32": "u", "uint16": "u", "uint8": "u"}


class Definitions(Protocol):
    """Definitions of messages from which headers are made; `Messages` implements it."""

    def fields(self, type_name: str) -> dict[str, str]:
        """Field names → ROS types."""
        ...

    def constants(self, type_name: str) -> dict[str, tuple[str, str]]:
        """Constant names → type and value."""
        ...

    def md5(self, type_name: str) -> str:
        """md5 sum."""
        ...

    def definition(self, type_name: str) -> str:
        """Definition, followed by those of nested types."""
        ...


class _Field(NamedTuple):
    name: str
    element: str
    """Type of the field, or of its elements."""
    length: int | None
    """None: a single value; 0: an array of any length; else the fixed length."""

    @property
    def is_message(self) -> bool:
        return "/" in self.element

    @property
    def cpp_element(self) -> str:
        if self.is_message:
            return f" ::{self.element.replace('/', '::')}_<ContainerAllocator> "
        return _STRING if self.element == "string" else _NUMBERS.get(self.element) or _TIMES[self.element]

    @property
    def cpp_type(self) -> str:
        if self.length is None:
            return self.cpp_element
        if self.length:
            return f"boost::array<{self.cpp_element}, {self.length}>"
        return f"std::vector<{self.cpp_element}, {_ALLOCATED}<{self.cpp_element}> >"

    def initial(self, allocator: str) -> str:
        """Member initializer; with an allocator, for types that take one."""
        if self.length or self.element in _TIMES:
            return f"{self.name}()" if self.length is None or self.length else f"{self.name}({allocator})"
        if self.length is None and self.element in _NUMBERS:
            return f"{self.name}({'false' if self.element == 'bool' else '0.0' if 'float' in self.element else '0'})"
        return f"{self.name}({allocator})"

    def filling(self, allocator: str) -> str:
        """Statement that fills an array of fixed length; empty if none is needed."""
        if not self.length or self.element in _TIMES:
            return ""
        value = "0" if self.element in _NUMBERS else f"{self.cpp_element}({allocator})"
        return f"    {self.name}.assign({value});\n"


def message_header(messages: Definitions, type_name: str, *, of_service: ServiceType | None = None) -> str:
    """Return the header of a message; for a request or response, it has the service's traits, too.

    Args:
        messages: definitions.
        type_name: such as 'geometry_msgs/Twist'.
        of_service: service to which the request or response belongs.
    """
    package, _, name = type_name.partition("/")
    fields = [_field(field, kind) for field, kind in messages.fields(type_name).items()]
    nested = sorted({field.element for field in fields if field.is_message})
    full = f"::{package}::{name}_<ContainerAllocator>"
    parts = [
        _opening(package, name, nested),
        _struct(package, name, fields, messages.constants(type_name)),
        _operators(full, fields),
        f"}}  // namespace {package}\n\nnamespace ros {{\nnamespace message_traits {{\n\n",
        _traits(messages, type_name, full, fields),
        "}  // namespace message_traits\n\nnamespace serialization {\n\n",
        _serializer(full, fields),
        "}  // namespace serialization\n\nnamespace message_operations {\n\n",
        _printer(full, fields),
        "}  // namespace message_operations\n}  // namespace ros\n",
        "" if of_service is None else _service_traits(of_service, f" {full} ", "<class ContainerAllocator>"),
        "\n#endif\n",
    ]
    return "".join(parts)


def service_header(service: ServiceType) -> str:
    """Return the header of a service."""
    package, _, name = service.type.partition("/")
    guard = f"{package.upper()}_MESSAGE_{name.upper()}_H"
    return f"""\
// Generated from {service.type}.srv
#ifndef {guard}
#define {guard}

#include <ros/service_traits.h>

#include <{package}/{name}Request.h>
#include <{package}/{name}Response.h>

namespace {package} {{

struct {name} {{
  typedef {name}Request Request;
  typedef {name}Response Response;
  Request request;
  Response response;
  typedef Request RequestType;
  typedef Response ResponseType;
}};

}}  // namespace {package}
{_service_traits(service, f" ::{package}::{name} ", "<>")}
#endif
"""


def nested_types(messages: Definitions, type_name: str) -> list[str]:
    """Return the message types of a type's fields."""
    fields = (_field(field, kind) for field, kind in messages.fields(type_name).items())
    return [field.element for field in fields if field.is_message]


def _field(name: str, kind: str) -> _Field:
    match = _ARRAY.fullmatch(kind)
    assert match is not None, kind
    count = match["count"]
    return _Field(name, match["element"], None if count is None else int(count or 0))


def _opening(package: str, name: str, nested: Iterable[str]) -> str:
    guard = f"{package.upper()}_MESSAGE_{name.upper()}_H"
    includes = "".join(f"#include <{kind}.h>\n" for kind in nested)
    return f"""\
// Generated from the definition of {package}/{name}
#ifndef {guard}
#define {guard}

#include <ros/builtin_message_traits.h>
#include <ros/message_operations.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>
#include <ros/types.h>

#include <memory>
#include <string>
#include <vector>

{includes}
namespace {package} {{

"""


def _struct(package: str, name: str, fields: Sequence[_Field], constants: dict[str, tuple[str, str]]) -> str:
    members = "".join(
        f"  typedef {field.cpp_type} _{field.name}_type;\n  _{field.name}_type {field.name};\n" for field in fields
    )
    enums, outside = _constants(name, constants)
    constructors: list[str] = []
    for parameter, allocator in (("", ""), ("const ContainerAllocator& _alloc", "_alloc")):
        initial = ", ".join(field.initial(allocator) for field in fields)
        filling = "".join(field.filling(allocator) for field in fields)
        unused = "    (void)_alloc;\n" if parameter else ""
        explicit = "explicit " if parameter else ""
        constructors.append(
            f"  {explicit}{name}_({parameter}){' : ' if initial else ''}{initial} {{\n{unused}{filling}  }}\n"
        )
    pointer = f"boost::shared_ptr< ::{package}::{name}_<ContainerAllocator>"
    return f"""\
template <class ContainerAllocator>
struct {name}_ {{
  typedef {name}_<ContainerAllocator> Type;

{"".join(constructors)}
{members}
{enums}
  typedef {pointer} > Ptr;
  typedef {pointer} const> ConstPtr;
}};

typedef ::{package}::{name}_<std::allocator<void> > {name};
typedef boost::shared_ptr< ::{package}::{name}> {name}Ptr;
typedef boost::shared_ptr< ::{package}::{name} const> {name}ConstPtr;

{outside}"""


def _constants(name: str, constants: dict[str, tuple[str, str]]) -> tuple[str, str]:
    """Return the declarations of constants inside the struct, and definitions after it."""
    inside: list[str] = []
    outside: list[str] = []
    for constant, (kind, text) in constants.items():
        if kind == "string" or kind.startswith("float"):
            cpp = _STRING if kind == "string" else _NUMBERS[kind]
            value = literal(text) if kind == "string" else _float(text)
            inside.append(f"  static const {cpp} {constant};\n")
            outside.append(
                f"template <typename ContainerAllocator>\nconst {cpp}\n"
                f"    {name}_<ContainerAllocator>::{constant} = {value};\n"
            )
        else:
            value = str(int(text.lower() in ("true", "1"))) if kind == "bool" else str(int(text, 0))
            inside.append(f"  enum {{ {constant} = {value}{_SUFFIXES.get(kind, '')} }};\n")
    return "".join(inside), "".join([*outside, "\n"] if outside else [])


def _float(text: str) -> str:
    lower = text.lower()
    if lower.lstrip("+-") in ("inf", "infinity", "nan"):
        function = '__builtin_nan("")' if "nan" in lower else "__builtin_inf()"
        return f"-{function}" if lower.startswith("-") else function
    return repr(float(text))


def literal(text: str) -> str:
    """Return a C++ string literal; other than ASCII is escaped in octal, as hexadecimal escapes have no end."""
    return '"' + "".join(_character(byte) for byte in text.encode()) + '"'


def _character(byte: int) -> str:
    character = chr(byte)
    if character in '"\\':
        return f"\\{character}"
    return character if character.isprintable() and byte < 128 and character != "?" else f"\\{byte:03o}"


def _operators(full: str, fields: Sequence[_Field]) -> str:
    left, right = (f"const ::{full[2:].replace('ContainerAllocator', a)}&" for a in ("A1", "A2"))
    equal = " &&\n         ".join(f"lhs.{field.name} == rhs.{field.name}" for field in fields) or "true"
    unused = "" if fields else "  (void)lhs;\n  (void)rhs;\n"
    return f"""\
template <typename ContainerAllocator>
std::ostream& operator<<(std::ostream& s, const {full}& v) {{
  ros::message_operations::Printer< {full} >::stream(s, "", v);
  return s;
}}
template <typename A1, typename A2>
bool operator==({left} lhs, {right} rhs) {{
{unused}  return {equal};
}}
template <typename A1, typename A2>
bool operator!=({left} lhs, {right} rhs) {{
  return !(lhs == rhs);
}}

"""


def _traits(messages: Definitions, type_name: str, full: str, fields: Sequence[_Field]) -> str:
    facts = ["IsMessage"]
    # Only a first field: the number of a message is written into its first four bytes.
    if any(
        field.name == "header" and field.element == "std_msgs/Header" and field.length is None for field in fields[:1]
    ):
        facts.append("HasHeader")
    if _is_fixed(messages, type_name, {}):
        facts.append("IsFixedSize")
    lines = messages.definition(type_name).splitlines(keepends=True) or [""]
    definition = "\n           ".join(map(literal, lines))
    values = {"MD5Sum": literal(messages.md5(type_name)), "DataType": literal(type_name), "Definition": definition}
    return "".join(
        [
            *(f"template <class ContainerAllocator>\nstruct {fact}< {full} > : TrueType {{}};\n" for fact in facts),
            *(
                f"""\
template <class ContainerAllocator>
struct {trait}< {full} > {{
  static const char* value() {{
    return {value};
  }}
  static const char* value(const {full}&) {{ return value(); }}
}};
"""
                for trait, value in values.items()
            ),
            "\n",
        ]
    )


def _is_fixed(messages: Definitions, type_name: str, known: dict[str, bool]) -> bool:
    if type_name not in known:
        known[type_name] = all(
            field.length != 0
            and field.element != "string"
            and (not field.is_message or _is_fixed(messages, field.element, known))
            for field in (_field(name, kind) for name, kind in messages.fields(type_name).items())
        )
    return known[type_name]


def _serializer(full: str, fields: Sequence[_Field]) -> str:
    body = "".join(f"    stream.next(m.{field.name});\n" for field in fields) or "    (void)stream;\n    (void)m;\n"
    return f"""\
template <class ContainerAllocator>
struct Serializer< {full} > {{
  template <typename Stream, typename T>
  inline static void allInOne(Stream& stream, T m) {{
{body}  }}
  ROS_DECLARE_ALLINONE_SERIALIZER
}};

"""


def _printer(full: str, fields: Sequence[_Field]) -> str:
    lines: list[str] = []
    for field in fields:
        if field.length is not None:
            lines.append(
                f'    printArray(s, indent, "{field.name}", v.{field.name}, {str(field.is_message).lower()});\n'
            )
            continue
        inner = 'indent + "  "'
        line_end = "\\n" if field.is_message else ""
        lines.append(f'    s << indent << "{field.name}: {line_end}";\n')
        lines.append(f"    Printer<{field.cpp_element}>::stream(s, {inner}, v.{field.name});\n")
    body = "".join(lines) or "    (void)s;\n    (void)indent;\n    (void)v;\n"
    return f"""\
template <class ContainerAllocator>
struct Printer< {full} > {{
  template <typename Stream>
  static void stream(Stream& s, const std::string& indent, const {full}& v) {{
{body}  }}
}};

"""


def _service_traits(service: ServiceType, cpp_type: str, template: str) -> str:
    values = {"MD5Sum": service.md5sum, "DataType": service.type}
    traits = "".join(
        f"""\
template {template}
struct {trait}<{cpp_type}> {{
  static const char* value() {{ return {literal(value)}; }}
  static const char* value(const {cpp_type}&) {{ return value(); }}
}};
"""
        for trait, value in values.items()
    )
    ending = "}  // namespace service_traits\n}  // namespace ros\n"
    return f"\nnamespace ros {{\nnamespace service_traits {{\n\n{traits}\n{ending}"

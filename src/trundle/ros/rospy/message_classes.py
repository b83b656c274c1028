"""Classes of messages and services, generated from definitions as by genpy."""

import keyword
import threading
from collections.abc import Callable
from functools import cache
from typing import Any

import genpy
from trundle.ros.errors import DefinitionError, MessageError

from .message_methods import METHODS
from .message_sources import find_definitions, service_halves
from .message_spec import Field, MessageSpec, canonical_text, full_text, md5sum, parse_message

_lock = threading.RLock()
_classes: dict[str, type[Any]] = {}
_services: dict[str, type[Any]] = {}
_TIMES: dict[str, type[Any]] = {"time": genpy.Time, "duration": genpy.Duration}


def message_class(type_name: str) -> type[Any]:
    """Class of a message type.

    Raises:
        MessageError: the type is unknown, or its definition invalid.
    """
    with _lock:
        return _classes.get(type_name) or _generate(message_spec(type_name), message_spec, "msg")


def service_class(type_name: str) -> type[Any]:
    """Class of a service type.

    Raises:
        MessageError: the type is unknown, or its definition invalid.
    """
    with _lock:
        return _services.get(type_name) or _generate_service(type_name)


@cache
def message_spec(type_name: str) -> MessageSpec:
    """Parsed definition of a message type.

    Raises:
        MessageError: the type is unknown, or its definition invalid.
    """
    package, _, name = type_name.partition("/")
    text = find_definitions(package).message(name)
    if text is None:
        raise MessageError(f"no message type {type_name!r}; put its package on ROS_PACKAGE_PATH")
    return parse_definition(type_name, text)


def parse_definition(type_name: str, text: str) -> MessageSpec:
    """Parse a definition; its errors name the type and the line.

    Raises:
        MessageError: the definition is invalid.
    """
    try:
        return parse_message(type_name, text)
    except DefinitionError as error:
        raise MessageError(f"the definition of {type_name} cannot be read: line {error.line}: {error}") from None


def classes_from_text(type_name: str, definition: str) -> dict[str, type[Any]]:
    """Classes of a type and its dependencies from a full definition, as in a connection header or a bag.

    Raises:
        MessageError: the definition is invalid.
    """
    main, *others = definition.split("=" * 80 + "\n")
    specs = {type_name: parse_definition(type_name, main.removesuffix("\n"))}
    for other in others:
        head, _, text = other.partition("\n")
        name = head.removeprefix("MSG: ").strip()
        specs[name] = parse_definition(name, text)

    def find(name: str) -> MessageSpec:
        return specs.get(name) or message_spec(name)

    classes: dict[str, type[Any]] = {}
    for spec in specs.values():
        _generate(spec, find, "msg", classes)
    return classes


def _generate_service(type_name: str) -> type[Any]:
    package, _, name = type_name.partition("/")
    text = find_definitions(package).service(name)
    if text is None:
        raise MessageError(f"no service type {type_name!r}; put its package on ROS_PACKAGE_PATH")
    halves = [
        parse_definition(f"{type_name}{half}", part)
        for half, part in zip(("Request", "Response"), service_halves(text), strict=True)
    ]
    request, response = (_generate(half, message_spec, "srv", module=f"{package}.srv._{name}") for half in halves)
    content = canonical_text(halves[0], message_spec) + canonical_text(halves[1], message_spec)
    from hashlib import md5

    attributes = {
        "_type": type_name,
        "_md5sum": md5(content.encode()).hexdigest(),
        "_request_class": request,
        "_response_class": response,
        "__module__": f"{package}.srv._{name}",
    }
    _services[type_name] = type(name, (), attributes)
    return _services[type_name]


def _generate(
    spec: MessageSpec,
    find: Callable[[str], MessageSpec],
    kind: str,
    classes: dict[str, type[Any]] | None = None,
    *,
    module: str | None = None,
) -> type[Any]:
    """Generate the class of a definition, after its fields' classes."""
    classes = _classes if classes is None else classes
    if spec.type in classes:
        return classes[spec.type]
    md5 = md5sum(spec, find)  # raises for a type that contains itself, too
    inner = {
        field.base: _generate(find(field.base), find, "msg", classes) if field.is_message else _TIMES[field.base]
        for field in spec.fields
        if field.is_message or field.base in _TIMES
    }
    package, _, name = spec.type.partition("/")
    attributes: dict[str, Any] = {constant.name: constant.value for constant in spec.constants}
    attributes |= METHODS
    attributes |= {
        "_type": spec.type,
        "_md5sum": md5,
        "_has_header": spec.has_header,
        "_full_text": full_text(spec, find),
        "__slots__": [attribute(field) for field in spec.fields],
        "_slot_types": [field.type for field in spec.fields],
        "_spec": spec,
        "_inner": inner,
        "__init__": _initializer(spec, inner),
        "__module__": module or f"{package}.{kind}._{name}",
        "__qualname__": name,
    }
    classes[spec.type] = type(name, (genpy.Message,), attributes)
    return classes[spec.type]


def attribute(field: Field) -> str:
    """Attribute of a field; a Python keyword gets a trailing `_`."""
    return f"{field.name}_" if keyword.iskeyword(field.name) else field.name


def _initializer(spec: MessageSpec, inner: dict[str, type[Any]]) -> Callable[..., None]:
    """Compile `__init__`: fields by position or keyword, ROS's default for the rest.

    Names in the code are those of fields, checked when the definition was parsed.
    """
    names = {f"_t{number}": cls for number, cls in enumerate(inner.values())}
    classes = dict(zip(inner, names, strict=True))
    fields = [(attribute(field), _default(field, classes)) for field in spec.fields]
    lines = ["def __init__(self, *args, **kwds):", "    if args or kwds:", "        _base(self, *args, **kwds)"]
    lines += [f"        if self.{name} is None: self.{name} = {default}" for name, default in fields]
    lines += ["    else:", *(f"        self.{name} = {default}" for name, default in fields), "        pass"]
    scope: dict[str, Any] = {"_base": genpy.Message.__init__, **names}
    exec("\n".join(lines), scope)
    return scope["__init__"]


def _default(field: Field, classes: dict[str, str]) -> str:
    """Expression of a field's default."""
    one = f"{classes[field.base]}()" if field.base in classes else _ZEROS.get(field.base, "0")
    if not field.array:
        return one
    length = field.length
    if field.base in ("uint8", "char"):
        return "b''" if length is None else f"b'\\0' * {length}"
    if length is None:
        return "[]"
    return f"[{one} for _ in range({length})]" if field.base in classes else f"[{one}] * {length}"


_ZEROS = {"string": "''", "bool": "False", "float32": "0.", "float64": "0."}

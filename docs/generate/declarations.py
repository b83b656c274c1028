"""Parameters, topics, services and actions of a plugin, node or controller, from the calls in its source that read,
advertise and subscribe."""

import ast
import importlib
import inspect
import re
import textwrap
from collections.abc import Iterator
from types import FunctionType, ModuleType
from typing import Any, NamedTuple

import msgspec

_TYPES = {
    "number": "number",
    "integer": "integer",
    "flag": "true or false",
    "text": "text",
    "string": "text",
    "texts": "texts",
    "vector": "three numbers",
    "numbers": "numbers",
}
"""Method that reads a parameter → its type."""
_STRUCT_TYPES = {bool: "true or false", int: "integer", float: "number", str: "text"}
_ENDPOINTS = {
    "advertise": "publishes",
    "subscribe": "subscribes",
    "advertise_service": "serves",
    "ActionServer": "serves the action",
    "service": "calls",
    "ActionClient": "calls the action",
}
_WINGS = ("trundle.gazebo.", "trundle.navigation.")
_READ_ELSEWHERE = ("trundle.gazebo.plugins.plugin", "trundle.gazebo.nodes.host")
_MESSAGE = re.compile(r"[a-z]\w*/[A-Z]\w+")
_COMPUTED = "…"


class Parameter(NamedTuple):
    """Parameter with its type and default."""

    name: str
    type: str
    default: str | None
    """None: required."""


class Endpoint(NamedTuple):
    """Topic, service or action."""

    kind: str
    """Verb: publishes, subscribes, serves or calls."""
    name: str
    type: str


class Declarations:
    """Parameters, topics and services in the source of one object and of the functions that it calls."""

    def __init__(self, target: type | FunctionType) -> None:
        self.parameters: dict[str, Parameter] = {}
        self.endpoints: dict[Endpoint, None] = {}
        self._seen: set[object] = set()
        self._visit(target)

    def _visit(self, target: object) -> None:
        target = inspect.unwrap(target) if callable(target) else target
        if target in self._seen or not isinstance(target, type | FunctionType):
            return
        self._seen.add(target)
        parts = [base for base in target.__mro__ if _is_ours(base)] if isinstance(target, type) else [target]
        for part in parts:
            self._seen.add(part)
            if isinstance(part, type) and issubclass(part, msgspec.Struct) and part.__name__.endswith("Settings"):
                self.add_struct(part)
            module = inspect.getmodule(part)
            try:
                tree = ast.parse(textwrap.dedent(inspect.getsource(part)))
            except (OSError, TypeError):
                continue
            assert module is not None
            _Reader(self, module, tree).read()

    def add(self, parameter: Parameter) -> None:
        """Add a parameter, unless an earlier call has it with a default; none whose whole name is computed."""
        if not re.sub(r"<[^>]*>|[_/]", "", parameter.name):
            return
        known = self.parameters.get(parameter.name)
        if known is None or known.default in (None, _COMPUTED):
            self.parameters[parameter.name] = parameter

    def names_parameter(self, name: str) -> bool:
        """True if a parameter or one of its sections has a name."""
        return any(name in known.split("/") for known in self.parameters)

    def add_struct(self, kind: type[msgspec.Struct]) -> None:
        """Add the fields of settings that are read as a struct; all have defaults."""
        try:
            defaults = kind()
        except TypeError:
            return
        for name in kind.__struct_fields__:
            default = getattr(defaults, name)
            if type(default) in _STRUCT_TYPES:
                self.add(Parameter(name, _STRUCT_TYPES[type(default)], _shown(default)))

    def visit(self, target: object) -> None:
        """Add what a called function or class of plugins and nodes declares."""
        if _is_ours(target):
            self._visit(target)


def _is_ours(target: object) -> bool:
    module = getattr(target, "__module__", None)
    return isinstance(module, str) and module.startswith(_WINGS) and not module.startswith(_READ_ELSEWHERE)


class _Reader:
    """Reads the calls in one class or function."""

    def __init__(self, declarations: Declarations, module: ModuleType, tree: ast.Module) -> None:
        self._declarations = declarations
        self._names: dict[str, Any] = dict(vars(module))
        self._tree = tree
        self._assigned: dict[str, ast.expr] = {}
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                self._names.update(_imported(node, module))
            elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                self._assigned.setdefault(node.targets[0].id, node.value)
            elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple):
                values = node.value.elts if isinstance(node.value, ast.Tuple) else []
                for target, value in zip(node.targets[0].elts, values, strict=False):
                    if isinstance(target, ast.Name):
                        self._assigned.setdefault(target.id, value)

    def read(self) -> None:
        for node in sorted(ast.walk(self._tree), key=lambda node: getattr(node, "lineno", 0)):
            if isinstance(node, ast.Call):
                self._call(node)
            elif isinstance(node, ast.Name | ast.Attribute):
                self._declarations.visit(self._resolved(node))

    def _call(self, call: ast.Call) -> None:
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        if name in _TYPES and isinstance(call.func, ast.Attribute):
            self._parameter(call, name)
        elif name == "read_settings" and call.args:
            kind = self._resolved(call.args[0])
            if isinstance(kind, type) and issubclass(kind, msgspec.Struct):
                self._declarations.add_struct(kind)
        elif name in _ENDPOINTS:
            self._endpoint(call, _ENDPOINTS[name])
        elif name in ("TransformBroadcaster", "StaticTransformBroadcaster"):
            topic = "/tf_static" if name.startswith("Static") else "/tf"
            self._declarations.endpoints[Endpoint("publishes", topic, "tf2_msgs/TFMessage")] = None
        elif name == "get" and call.args and isinstance(call.args[0], ast.Constant):
            key = call.args[0].value
            if isinstance(key, str) and key.startswith("~") and len(key) > 1:
                default = self._value(call.args[1]) if len(call.args) > 1 else None
                self._declarations.add(Parameter(key[1:], "", default))

    def _parameter(self, call: ast.Call, method: str) -> None:
        if not call.args:
            return
        for name in self._texts(call.args[0]):
            position = 2 if method == "numbers" else 1
            given = [keyword.value for keyword in call.keywords if keyword.arg == "default"]
            given += call.args[position : position + 1]
            default = self._value(given[0]) if given else None
            if method in ("string", "texts") and default is None:
                default = ""
            self._declarations.add(Parameter(self._section(call.func) + name, _TYPES[method], default))

    def _section(self, function: ast.expr) -> str:
        """Return the sections of `parameters.section("a").number("b")` as a prefix."""
        receiver = function.value if isinstance(function, ast.Attribute) else None
        if isinstance(receiver, ast.Name):
            receiver = self._assigned.get(receiver.id)
        if isinstance(receiver, ast.Call) and getattr(receiver.func, "attr", "") == "section" and receiver.args:
            (name,) = [*self._texts(receiver.args[0])][:1] or [""]
            return f"{self._section(receiver.func)}{name}/" if name else ""
        return ""

    def _endpoint(self, call: ast.Call, kind: str) -> None:
        texts = [text for argument in call.args[:3] for text in [*self._texts(argument)][:1]]
        types = [text for text in texts if _MESSAGE.fullmatch(text)]
        others = [argument for argument in call.args[:3] if not set(self._texts(argument)) & set(types)]
        if not types:
            return
        if isinstance(call.func, ast.Name):
            others = others[1:]  # the node
        name = self._topic(others[0]) if others else _COMPUTED
        self._declarations.endpoints[Endpoint(kind, name, types[0])] = None

    def _topic(self, node: ast.expr) -> str:
        if isinstance(node, ast.Name) and node.id in self._assigned:
            node = self._assigned[node.id]
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in ("text", "string") and node.args:
            (parameter,) = [*self._texts(node.args[0])][:1] or [_COMPUTED]
            default = next((keyword.value for keyword in node.keywords if keyword.arg == "default"), None)
            default = default or (node.args[1] if len(node.args) > 1 else None)
            shown = self._value(default) if default is not None else ""
            return f"{shown} ({parameter})" if shown and shown != _COMPUTED else f"({parameter})"
        return next(self._texts(node), f"<{_word(node)}>")

    def _texts(self, node: ast.expr) -> Iterator[str]:
        """Yield the possible values of an expression for a name."""
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.JoinedStr):
            yield "".join(_part(value) for value in node.values)
        elif isinstance(node, ast.IfExp):
            yield from self._texts(node.body)
            yield from self._texts(node.orelse)
        elif isinstance(node, ast.Name | ast.Attribute):
            value = self._resolved(node)
            if isinstance(value, str):
                yield value

    def _value(self, node: ast.expr) -> str:
        try:
            return _shown(ast.literal_eval(node))
        except ValueError:
            pass
        value = self._resolved(node)
        if isinstance(value, int | float | str | tuple):
            return _shown(value)
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in _TYPES:  # an older name of the parameter
            given = [keyword.value for keyword in node.keywords if keyword.arg == "default"] + node.args[1:2]
            return self._value(given[0]) if given else _COMPUTED
        try:
            return _shown(eval(compile(ast.Expression(node), "", "eval"), dict(self._names)))  # a constant's expression
        except Exception:  # it depends on the run
            return _COMPUTED

    def _resolved(self, node: ast.expr) -> Any:
        """Return the module's object of a name; None: a local one."""
        if isinstance(node, ast.Name):
            return self._names.get(node.id)
        if isinstance(node, ast.Attribute):
            owner = self._resolved(node.value)
            return getattr(owner, node.attr, None) if isinstance(owner, type | ModuleType) else None
        return None


def _imported(node: ast.ImportFrom, module: ModuleType) -> dict[str, Any]:
    package = module.__package__ or ""
    name = "." * node.level + (node.module or "")
    try:
        source = importlib.import_module(name, package)
    except ImportError:
        return {}
    return {alias.asname or alias.name: getattr(source, alias.name, None) for alias in node.names}


def _part(node: ast.expr) -> str:
    """Return a part of an f-string: text, or `<word>` for what is computed."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    value = node.value if isinstance(node, ast.FormattedValue) else node
    return "~" if ast.unparse(value).endswith("node.name") else f"<{_word(value)}>"


def _word(node: ast.expr) -> str:
    """Return the noun of an expression: `model` for `ros_name(self._model.name)`."""
    if isinstance(node, ast.Call):
        return _word(node.args[0] if node.args else node.func)
    if isinstance(node, ast.Subscript):
        return _word(node.value)
    if isinstance(node, ast.Attribute):
        return _word(node.value) if node.attr == "name" else node.attr.strip("_")
    return node.id.strip("_") if isinstance(node, ast.Name) else "name"


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, tuple | list):
        return " ".join(map(_shown, value))
    return str(value)

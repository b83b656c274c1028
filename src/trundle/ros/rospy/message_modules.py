"""Loader of `PACKAGE.msg` and `PACKAGE.srv`, whose classes are generated on first use."""

from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from trundle.ros.errors import MessageError

from .message_classes import message_class, service_class
from .message_sources import find_definitions


class MessagesLoader:
    """Loader of the module of a package's messages or services, or of one type's module."""

    def __init__(self, package: str, kind: str, name: str) -> None:
        """Create; `kind` is msg or srv, `name` a type or ''."""
        self._package = package
        self._kind = kind
        self._name = name

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave the module to Python."""

    def exec_module(self, module: ModuleType) -> None:
        """Fill the module.

        Raises:
            ImportError: the package has no such type.
        """
        namespace: Any = module.__dict__
        if self._name:
            namespace.update(self._types(self._name, module.__name__))
            return
        names = find_definitions(self._package).names(self._kind)
        halves = ("", "Request", "Response") if self._kind == "srv" else ("",)
        types = [f"{name}{half}" for name in names for half in halves]

        def get(name: str) -> object:
            if name.startswith("__"):
                raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
            message_type = self._find(name)
            if message_type is None:
                raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
            namespace.setdefault(name, message_type)
            return namespace[name]

        namespace.update(__getattr__=get, __all__=types, __dir__=lambda: sorted({*namespace, *types}))

    def _find(self, name: str) -> object:
        if self._kind == "msg":
            return _message(f"{self._package}/{name}")
        for half in ("", "Request", "Response"):
            if name.endswith(half) and (service := _service(f"{self._package}/{name.removesuffix(half)}")) is not None:
                return _service_types(service).get(name)
        return None

    def _types(self, name: str, module: str) -> dict[str, object]:
        type_name = f"{self._package}/{name}"
        cls = _message(type_name) if self._kind == "msg" else _service(type_name)
        if cls is None:
            raise ModuleNotFoundError(f"No module named {module!r}", name=module)
        return {name: cls} if self._kind == "msg" else _service_types(cls)


def _service_types(service: Any) -> dict[str, object]:
    """A service's class, request and response, by their names."""
    types = (service, service._request_class, service._response_class)
    return {cls.__name__: cls for cls in types}


def _message(type_name: str) -> type[Any] | None:
    package, _, name = type_name.partition("/")
    if find_definitions(package).message(name) is None:
        return None
    return _generate(lambda: message_class(type_name), type_name)


def _service(type_name: str) -> type[Any] | None:
    package, _, name = type_name.partition("/")
    if find_definitions(package).service(name) is None:
        return None
    return _generate(lambda: service_class(type_name), type_name)


def _generate(create: Any, type_name: str) -> Any:
    try:
        return create()
    except MessageError as error:
        raise ImportError(f"{type_name} cannot be imported: {error}") from None

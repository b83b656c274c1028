"""Parameters and command line of the servers."""

from trundle.robots.parameters import ParamError, RosParameters

from ..globs import read_globs
from .shared import Options

_UNSUPPORTED = {
    "bson_only_mode": "BSON is not supported; clients use JSON or CBOR",
    "authenticate": "rosauth is not supported; use ~token and ~allowed_origins",
}
_FLAGS = frozenset({"bson_only_mode", "use_compression"})


def apply_arguments(tree: dict[str, object], arguments: list[str]) -> dict[str, object]:
    """Override parameters by a command line like `--port 9091`.

    Raises:
        ParamError: an argument without a value.
    """
    merged = dict(tree)
    rest = iter(arguments)
    for argument in rest:
        name = argument.removeprefix("--")
        if name == argument:
            continue
        if name in _FLAGS:
            merged[name] = True
            continue
        value = next(rest, None)
        if value is None:
            raise ParamError(f"--{name} argument provided without a value.")
        merged[name] = value
    return merged


def read_options(settings: RosParameters) -> Options:
    """Read the options of the protocol.

    Raises:
        ParamError: a parameter is invalid or not supported.
    """
    for name, reason in _UNSUPPORTED.items():
        if settings.flag(name, default=False):
            raise ParamError(f"parameter {settings.namespace}/{name}: {reason}")
    if "binary_encoder" in settings and settings.text("binary_encoder") not in ("default", "b64"):
        raise ParamError(f"parameter {settings.namespace}/binary_encoder: {_UNSUPPORTED['bson_only_mode']}")
    globs = {
        name: read_globs(settings.text(name), f"{settings.namespace}/{name}") if name in settings else ()
        for name in ("topics_glob", "services_glob")
    }
    services = globs["services_glob"]
    return Options(
        fragment_timeout_s=settings.number("fragment_timeout", 600.0, minimum=0.0),
        fragment_size=_optional_integer(settings, "max_message_size"),
        unregister_timeout_s=settings.number("unregister_timeout", 10.0, minimum=0.0),
        topics_glob=globs["topics_glob"],
        services_glob=(*services, "/rosapi/*") if services else (),
    )


def _optional_integer(settings: RosParameters, name: str) -> int | None:
    """Read a number, or the text None."""
    if name not in settings:
        return None
    try:
        if settings.text(name) in ("None", ""):
            return None
    except ParamError:
        pass
    return settings.integer(name, minimum=1)

"""Parameters, and YAML files of them."""

import math
import os
import re
import sys
from typing import Any

import yaml

import rosgraph
from rosgraph.binary import unwrap_bytes
from rosgraph.names import get_ros_namespace, make_global_ns, ns_join

NAME = "rosparam"
NS = "_ns"
_MAX_INT = 2**31 - 1


class RosParamException(Exception):
    """Base class."""


class RosParamIOException(RosParamException):
    """The master does not respond."""


def get_param_server() -> rosgraph.Master:
    """Client of the parameter server."""
    return rosgraph.Master(rosgraph.names.make_caller_id(f"{NAME}-{os.getpid()}"))


def load_file(
    filename: str | None, default_namespace: str | None = None, verbose: bool = False
) -> list[tuple[Any, str]]:
    """Parameters of a YAML file, or of stdin ('-'), with their namespaces: one pair per document.

    Raises:
        RosParamException: no such file.
    """
    if not filename or filename == "-":
        return load_str(sys.stdin.read(), str(filename), default_namespace, verbose)
    if not os.path.isfile(filename):
        raise RosParamException(f"file [{filename}] does not exist")
    if verbose:
        print(f"reading parameters from [{filename}]")
    with open(filename, encoding="utf-8") as file:
        return load_str(file.read(), filename, default_namespace, verbose)


def load_str(
    str: str, filename: str, default_namespace: str | None = None, verbose: bool = False
) -> list[tuple[Any, str]]:
    """Parameters of YAML text, with their namespaces."""
    del filename
    default = default_namespace or get_ros_namespace()
    documents: list[tuple[Any, Any]] = []
    for document in yaml.load_all(str, _Loader):
        namespace = default
        if isinstance(document, dict) and NS in document:
            namespace = ns_join(default, document.pop(NS))
            if verbose:
                print(f"reading parameters into namespace [{namespace}]")
        documents.append((document, namespace))
    return documents


def get_param(param: str) -> Any:
    """Value of a parameter, or a namespace as a dictionary."""
    return _call(lambda: get_param_server().getParam(param))


def dump_params(filename: str | None, param: str, verbose: bool = False) -> None:
    """Write a namespace as YAML, to a file or stdout."""
    tree = get_param(param)
    if verbose:
        print_params(tree, param)
    if not filename:
        yaml.dump(tree, sys.stdout, _Dumper)
        return
    with open(filename, "w", encoding="utf-8") as file:
        yaml.dump(tree, file, _Dumper)


def delete_param(param: str, verbose: bool = False) -> None:
    """Delete a parameter, or all below '/'."""
    master = get_param_server()
    names = [f"/{name}" for name in _call(lambda: master.getParam("/"))] if param in ("/", "//") else [param]
    for name in names:
        _call(lambda name=name: master.deleteParam(name))
        if verbose:
            print(f"deleted parameter [{name}]")


def set_param_raw(param: str, value: Any, verbose: bool = False) -> None:
    """Set a parameter; a dictionary is merged into an existing one.

    Raises:
        RosParamException: a key that is not text, or an integer of more than 32 bits.
    """
    if type(value) is dict:
        for name, part in value.items():
            if not isinstance(name, str):
                raise RosParamException(f"YAML dictionaries must have string keys. Invalid dictionary is:\n{value}")
            set_param_raw(ns_join(param, name), part, verbose)
        return
    if type(value) is int and not -_MAX_INT - 1 <= value <= _MAX_INT:
        text = "Overflow: Parameter Server integers must be 32-bit signed integers:"
        raise RosParamException(f"{text}\n\t-{_MAX_INT - 1} <= value <= {_MAX_INT}")
    _call(lambda: get_param_server().setParam(param, value))
    if verbose:
        print(f"set parameter [{param}] to [{value}]")


def set_param(param: str, value: str, verbose: bool = False) -> None:
    """Set a parameter to a YAML value."""
    set_param_raw(param, yaml.load(value, _Loader), verbose)


def upload_params(ns: str, values: Any, verbose: bool = False) -> None:
    """Set the parameters of a namespace.

    Raises:
        RosParamException: the namespace is '/', and the value not a dictionary.
    """
    if ns == "/" and type(values) is not dict:
        raise RosParamException("global / can only be set to a dictionary")
    if verbose:
        print_params(values, ns)
    set_param_raw(ns, values)


def list_params(ns: str) -> list[str]:
    """Names of the parameters in a namespace."""
    names = sorted(_call(lambda: get_param_server().getParamNames()))
    return [name for name in names if name.startswith(make_global_ns(ns))]


def print_params(params: Any, ns: str) -> None:
    """Print a tree of parameters, one per line."""
    if type(params) is not dict:
        print(params)
        return
    for name, value in params.items():
        if type(value) is dict:
            print_params(value, ns_join(ns, name))
        else:
            print(f"{ns_join(ns, name)}={value}")


def _call(call: Any) -> Any:
    try:
        return call()
    except OSError:
        raise RosParamIOException("Unable to communicate with master!") from None


class _Loader(yaml.SafeLoader):
    """YAML with angles: `deg(90)`, `rad(pi/2)`, `!degrees 90`, `!radians pi`."""


class _Dumper(yaml.SafeDumper):
    """YAML with binary values, as `!!binary`."""

    def represent_data(self, data: Any) -> Any:
        return super().represent_data(unwrap_bytes(data))


_ANGLE = re.compile(r"^(deg|rad)\((.*)\)$")


def _angle(text: str, *, is_degrees: bool) -> float:
    from trundle.base.expressions import MATH_NAMES, Interpreter

    value = Interpreter().evaluate_number(text, MATH_NAMES)
    return math.radians(value) if is_degrees else value


def _construct_angle(loader: Any, node: Any) -> float:
    match = _ANGLE.match(loader.construct_scalar(node))
    assert match is not None
    return _angle(match[2], is_degrees=match[1] == "deg")


def _construct_degrees(loader: Any, node: Any) -> float:
    return _angle(loader.construct_scalar(node), is_degrees=True)


def _construct_radians(loader: Any, node: Any) -> float:
    return _angle(loader.construct_scalar(node), is_degrees=False)


_Loader.add_implicit_resolver("!angle", _ANGLE, list("dr"))
_Loader.add_constructor("!angle", _construct_angle)
_Loader.add_constructor("!degrees", _construct_degrees)
_Loader.add_constructor("!radians", _construct_radians)


def yamlmain(argv: list[str] | None = None) -> None:
    """Run the command rosparam with its arguments; default: this process's arguments.

    Raises:
        SystemExit: it failed.
    """
    from trundle.app.cli.main import main

    if (code := main(["param", *(sys.argv if argv is None else argv)[1:]])) != 0:
        sys.exit(code)

"""xacro's global symbols as functions of our interpreter."""

import re
from collections.abc import Callable, Mapping, Sequence
from types import FunctionType
from typing import Any

from trundle.base.expressions import Budget, Caller, Function, Interpreter, is_method, known_keys, wrap_function

_DEPRECATED = {"sorted": "python", "range": "python", "load_yaml": "xacro", "abs_filename": "xacro", "dotify": "xacro"}
"""Functions callable without their namespace, with a warning."""
_STEPS_OF_A_YAML_VALUE = 20


def install_symbols(package: Any) -> None:
    """Replace the package's functions for expressions, some of which have unrestricted access."""

    def dotify(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        return package.YamlDictWrapper(caller.call(dict, values, named))

    symbols = package._global_symbols
    functions, python = symbols["xacro"], symbols["python"]
    dict.pop(python, "vars")  # would give access to hidden names
    dict.pop(python, "hash")  # would reveal which texts collide in a dictionary
    dict.update(
        functions,
        load_yaml=Function("load_yaml", _yaml_reader(package)),
        tokenize=wrap_function(_tokenize, "tokenize"),
        dotify=Function("dotify", dotify),
    )
    for name, value in list(dict.items(functions)):
        if isinstance(value, FunctionType):
            dict.__setitem__(functions, name, wrap_function(value, name))
    for name, space in _DEPRECATED.items():
        symbols[name] = Function(name, _deprecated(package, name, space, symbols[space][name]))
    package.Table.__repr__ = package.Table.__str__ = _namespace_text  # the package's own prints all contents


def new_interpreter(package: Any) -> Interpreter:
    """Create an interpreter for the expressions of one file."""

    def dotted(owner: Any, name: str) -> Any:
        if isinstance(owner, package.Table):
            return package.NameSpace.__getattr__(owner, name)
        if isinstance(owner, package.YamlDictWrapper) and not is_method(dict, name):
            try:
                return package.YamlDictWrapper.__getattr__(owner, name)
            except AttributeError as error:
                raise AttributeError(f"{error}{known_keys(owner)}") from None
        return NotImplemented

    return Interpreter(dotted=dotted)


def _namespace_text(_: object) -> str:
    return "<namespace>"


def _deprecated(package: Any, name: str, space: str, value: Any) -> Callable[..., Any]:
    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        package.warning(f"Using {name}() directly is deprecated. Use {space}.{name}() instead.")
        return caller.call(value, values, named)

    return call


def _tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """Split a text as the package does; separators are characters, never a pattern with exponential time."""
    items = re.split("[{}]".format(re.sub(r"([\[\]\\^])", r"\\\1", sep)), text)
    return [item for item in items if item] if skip_empty else items


def _yaml_of(text: str, name: str, package: Any, budget: Budget) -> Any:
    """Load YAML with xacro's units, such as `!degrees 90`."""
    from yaml import YAMLError  # slow to load, and most robots have none

    from trundle.base.yaml_loader import BoundedLoader, load_yaml, one_line

    class Loader(BoundedLoader):
        pass

    for unit in package.ConstructUnits:
        Loader.add_constructor(unit.value.tag, unit.constructor)
    try:
        return load_yaml(text, Loader, lambda count: budget.spend(_STEPS_OF_A_YAML_VALUE * count))
    except YAMLError as error:
        raise package.XacroException(f"{name}: {one_line(error)}") from None


def _yaml_reader(package: Any) -> Callable[[Caller, Sequence[Any], Mapping[str, Any]], Any]:
    def read(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        (filename,) = (*values, *named.values())
        name = package.abs_filename_spec(filename)
        with package.open(name) as file:
            text = file.read()
        caller.budget.spend(len(text))
        package.filestack.append(name)
        try:
            return package.YamlListWrapper.wrap(_yaml_of(text, name, package, caller.budget))
        finally:
            package.filestack.pop()
            package.all_includes.append(name)

    return read


class SubstitutedNames:
    """Names in a `$(eval …)`, with functions from the package; the package itself allows every builtin."""

    def __init__(self, symbols: Any, others: Mapping[str, object]) -> None:
        self._symbols, self._others = symbols, others

    def __getitem__(self, name: str) -> Any:
        """Return the value of a name.

        Raises:
            KeyError: it is not defined.
        """
        try:
            value = self._symbols[name]
        except KeyError:
            return self._others[name]
        return wrap_function(value, name) if isinstance(value, FunctionType) else value

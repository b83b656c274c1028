"""Imports, including imports for types, have no cycles.

A name imported from a package counts as an import of the module that defines it.
"""

import ast
from collections.abc import Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import trundle

_ROOT = Path(trundle.__file__).parent


def _name(path: Path) -> str:
    parts = path.relative_to(_ROOT.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


_FILES = {_name(path): path for path in _ROOT.rglob("*.py")}


def _base(module: str, path: Path, node: ast.ImportFrom) -> str:
    """Return the absolute module name of a `from … import`."""
    if node.level == 0:
        return node.module or ""
    package = module.split(".") if path.stem == "__init__" else module.split(".")[:-1]
    return ".".join([*package[: len(package) - node.level + 1], *filter(None, [node.module])])


def _origin(base: str, name: str) -> str:
    """Return the module that defines `name` of `base`, also through packages' stubs."""
    if f"{base}.{name}" in _FILES:
        return f"{base}.{name}"
    source = _exports(base).get(name)
    return base if source not in _FILES else _origin(source, name)


@cache
def _exports(room: str) -> dict[str, str]:
    """Return the names in a package's stub, with the modules that they are imported from."""
    stub = _FILES[room].with_suffix(".pyi")
    body = ast.parse(stub.read_text()).body if stub.exists() else []
    imports = [node for node in body if isinstance(node, ast.ImportFrom)]
    return {alias.name: _base(room, stub, node) for node in imports for alias in node.names}


def _imports(module: str, path: Path) -> Iterator[str]:
    """Yield Trundle's modules that a module imports: at its top, in functions, and only for types."""
    stub = path.with_suffix(".pyi")
    texts = [path.read_text()] if path.stem == "__init__" or not stub.exists() else [path.read_text(), stub.read_text()]
    for node in (node for text in texts for node in ast.walk(ast.parse(text))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in _FILES)
        elif isinstance(node, ast.ImportFrom) and (base := _base(module, path, node)) in _FILES:
            yield from (_origin(base, alias.name) for alias in node.names)


def test_imports_have_no_cycles() -> None:
    graph = {module: set(_imports(module, path)) for module, path in _FILES.items()}
    cycle: list[str] = []
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        cycle = error.args[1]

    assert cycle == []

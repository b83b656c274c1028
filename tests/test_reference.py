"""The reference of the Python API: it names what `trundle` has, with units, shapes and an example of each call."""

import ast
import importlib
import inspect
import re
import runpy
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import trundle

_ROOT = Path(__file__).parents[1]
if not (_ROOT / "docs/generate/api.py").is_file():
    pytest.skip("the documentation is not part of the sdist", allow_module_level=True)
_API: dict[str, Any] = runpy.run_path(str(_ROOT / "docs/generate/api.py"))
_MEMBERS: dict[str, str] = {name: members for names in _API["PUBLIC"].values() for name, members in names.items()}
_MARK = '__module__ = "trundle"'
_ARRAY = re.compile(r"\b(NDArray|_Array)\b")
_NUMBER = re.compile(r"\b(float|Vector3|ArrayLike|PoseLike|TwistLike|WrenchLike)\b")
_SHAPE = re.compile(r"\([\w…·, +]+\)")
_UNIT = re.compile(
    r"\[[^\]]+\]|\b(0 to 1|[Uu]nit|direction|axis|factor|color|scale|[Ff]riction|coefficient|[Rr]atio|step size)\b"
)
"""A unit in brackets, or a word for a number without one."""


@cache
def _classes() -> dict[str, ast.ClassDef]:
    """Return the definitions of the public classes, by name."""
    found: dict[str, ast.ClassDef] = {}
    for file in (_ROOT / "src/trundle").rglob("*.py"):
        text = file.read_text()
        if _MARK in text:
            for node in ast.walk(ast.parse(text)):
                if isinstance(node, ast.ClassDef) and any(
                    ast.unparse(part) == _MARK.replace('"', "'") for part in node.body
                ):
                    found[node.name] = node
    return found


def _documented(body: list[ast.stmt], prefix: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield name, annotations and docstring of each method, field and attribute that `__init__` sets."""
    for part, after in zip(body, [*body[1:], ast.Pass()], strict=True):
        doc = after.value.value if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) else ""
        match part:
            case ast.FunctionDef(name="__init__"):
                yield from _documented(part.body, "self.")
            case ast.FunctionDef(decorator_list=[ast.Attribute(attr="setter")]):
                pass  # the property has the docstring
            case ast.FunctionDef():
                arguments = (*part.args.args, *part.args.kwonlyargs)
                annotations = [*(argument.annotation for argument in arguments), part.returns]
                yield part.name, " ".join(ast.unparse(a) for a in annotations if a), ast.get_docstring(part) or ""
            case ast.AnnAssign():
                yield ast.unparse(part.target).removeprefix(prefix), ast.unparse(part.annotation), str(doc)
            case ast.Assign(targets=[target]) if prefix:
                yield ast.unparse(target).removeprefix(prefix), "", str(doc)
            case _:
                pass


def _public_members() -> list[tuple[str, str, str, str]]:
    """Return class, member, annotations and docstring of everything in the reference."""
    rows: list[tuple[str, str, str, str]] = []
    for name, members in _MEMBERS.items():
        if name in _classes():
            parts = list(_documented(_classes()[name].body))
            wanted = {part[0] for part in parts if part[0][0] != "_"} if members == "*" else set(members.split())
            rows += [(name, *part) for part in parts if part[0] in wanted]
    return rows


def test_the_reference_has_all_public_names() -> None:
    everything = set(getattr(trundle, "__all__"))  # noqa: B009  # the stub has no `__all__`
    assert set(_MEMBERS) == everything - {"ros", "spatial"}
    assert {package.removeprefix("trundle.") for package in _API["PACKAGES"]} == {"ros", "spatial", "gym"}


def test_members_in_the_reference_exist() -> None:
    documented = {(row[0], row[1]) for row in _public_members()}
    missing = [
        f"{name}.{member}"
        for name, members in _MEMBERS.items()
        for member in members.split()
        if member != "*" and (name, member) not in documented and not hasattr(getattr(trundle, name), member)
    ]
    assert missing == []
    assert len(documented) > 250


def test_all_public_members_have_docstrings_with_units_and_shapes() -> None:
    faults = []
    for owner, member, annotations, doc in _public_members():
        if not doc and _NUMBER.search(annotations):
            faults.append(f"{owner}.{member}: no docstring")
        elif _ARRAY.search(annotations) and not _SHAPE.search(doc):
            faults.append(f"{owner}.{member}: no shape: {doc}")
        elif _NUMBER.search(annotations) and not _UNIT.search(doc):
            faults.append(f"{owner}.{member}: no unit: {doc}")
    assert faults == []


def test_all_public_calls_have_an_example() -> None:
    example_of = _API["example_of"]
    calls = [(name, False) for name in _MEMBERS if inspect.isfunction(getattr(trundle, name))]
    for name, members in _MEMBERS.items():
        methods = [
            member for member in members.split() if inspect.isroutine(getattr(getattr(trundle, name), member, None))
        ]
        calls += [(method, True) for method in methods]

    assert len(calls) > 80
    assert [name for name, is_member in calls if example_of(name, is_member=is_member) is None] == []


_HELD = (
    "Simulation LoadedSimulation SavedSimulation StrideProfile ModelHandle LinkHandle JointHandle View Film "
    "Recording Plot World Model Link Joint"
)


@pytest.mark.parametrize("name", _HELD.split())
def test_completion_shows_what_the_reference_documents(name: str) -> None:
    """What other rooms call of an object is left out of `dir`."""
    kind = getattr(trundle, name)
    documented = {member for base in kind.__mro__ for member in _MEMBERS.get(base.__name__, "").split()}

    shown = {member for member in kind.__dir__(kind) if not member.startswith("_")}

    assert shown == documented


def _package_functions() -> Iterator[tuple[str, Any]]:
    """Yield the functions, methods and properties of the packages' public names."""
    for package, names in _API["PACKAGES"].items():
        for name in names.split():
            value = getattr(importlib.import_module(package), name)
            if inspect.isfunction(value):
                yield f"{package}.{name}", value
            for member, part in vars(value).items() if inspect.isclass(value) else ():
                function = part.fget if isinstance(part, property) else part
                if not member.startswith("_") and inspect.isfunction(function):
                    yield f"{package}.{name}.{member}", function


def test_arrays_of_packages_have_shapes() -> None:
    functions = list(_package_functions())
    faults = [
        name
        for name, function in functions
        if re.search(r"ndarray|NDArray|_Array", " ".join(map(str, function.__annotations__.values())))
        and not re.search(rf"{_SHAPE.pattern}|^See `", function.__doc__ or "")
    ]
    assert len(functions) > 80
    assert faults == []


def test_the_names_of_the_packages_have_an_example() -> None:
    example_of = _API["example_of"]
    names = [
        name
        for package in ("trundle.gym", "trundle.ros", "trundle.spatial")
        for name in _API["PACKAGES"][package].split()
    ]
    assert [name for name in names if example_of(name) is None] == []


def test_the_reference_has_all_names_of_gym() -> None:
    assert set(_API["PACKAGES"]["trundle.gym"].split()) == set(getattr(trundle.gym, "__all__"))  # noqa: B009  # the stub has no `__all__`


def test_errors_are_in_the_docstrings() -> None:
    """A public method that checks its arguments says so."""
    silent = [
        f"{owner}.{member}"
        for owner, member, _, doc in _public_members()
        if member.startswith(("set_", "command_", "apply_", "add_", "run", "step", "spawn", "film", "record", "plot"))
        and member != "step_ns"
        and "Raises:" not in doc
        and "; see `" not in doc
    ]
    assert silent == []

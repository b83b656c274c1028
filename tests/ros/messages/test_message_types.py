"""Annotations of messages, against the definitions and against message objects."""

import ast
import importlib.util
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from trundle.ros import Messages

ROOT = Path(__file__).parents[3]
STUB = ROOT / "src/trundle/ros/message_types.pyi"
PYTHON = {"bool": bool, "int": int, "float": float, "str": str}


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("message_types", ROOT / "typings/message_types.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _classes() -> Iterator[tuple[str, ast.ClassDef]]:
    for package in ast.parse(STUB.read_text()).body:
        if isinstance(package, ast.ClassDef):
            for message in package.body:
                if isinstance(message, ast.ClassDef):
                    yield f"{package.name}/{message.name}", message


def test_the_stub_matches_the_definitions(script: ModuleType) -> None:
    assert script.stub() == STUB.read_text(), "run make format"


def test_message_fields_have_their_annotated_types() -> None:
    messages = Messages()
    count = 0
    for name, message in _classes():
        service = name.removesuffix("Request")
        if service != name:
            messages.service(service)
        instance = messages.new(name)
        for field in message.body:
            if not isinstance(field, ast.AnnAssign) or not isinstance(field.target, ast.Name):
                continue
            value, kind = getattr(instance, field.target.id), ast.unparse(field.annotation)
            count += 1
            if kind in PYTHON:
                assert isinstance(value, PYTHON[kind]), f"{name}.{field.target.id}"
            elif kind.startswith("NDArray"):
                assert value.dtype == getattr(np, kind.removeprefix("NDArray[np.").removesuffix("]"))
            elif kind.startswith("list"):
                assert isinstance(value, list)
            else:
                assert hasattr(value, "__msgtype__")
    assert count > 200

"""Evaluation for these tests: every function that an expression may call has a name."""

from typing import Any

from trundle.base.expressions import MATH_NAMES, Interpreter
from trundle.base.expressions.functions import GUARDED

NAMES: dict[str, Any] = {**MATH_NAMES, **{each.__name__: each for each in GUARDED}}


def evaluate(text: str, **names: Any) -> Any:
    return Interpreter().evaluate(text, {**NAMES, **names})

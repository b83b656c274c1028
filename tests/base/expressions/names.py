"""Evaluation with a name for every function that an expression may call."""

from typing import Any

from trundle.base.expressions import MATH_NAMES, Interpreter
from trundle.base.expressions.functions import GUARDED

NAMES: dict[str, Any] = {**MATH_NAMES, **{function.__name__: function for function in GUARDED}}


def evaluate(text: str, **names: Any) -> Any:
    return Interpreter().evaluate(text, {**NAMES, **names})

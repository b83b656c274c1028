"""Expressions that a file holds: text and names enter, a value leaves; no code of Python runs."""

from .budget import Budget, ExpressionError
from .functions import MATH_NAMES, PYTHON_NAMES
from .interpreter import Interpreter
from .methods import is_method
from .values import Caller, Function, function_of

__all__ = [
    "MATH_NAMES",
    "PYTHON_NAMES",
    "Budget",
    "Caller",
    "ExpressionError",
    "Function",
    "Interpreter",
    "function_of",
    "is_method",
]

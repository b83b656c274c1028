from .budget import Budget as Budget, ExpressionError as ExpressionError
from .containers import known_keys as known_keys
from .functions import MATH_NAMES as MATH_NAMES, PYTHON_NAMES as PYTHON_NAMES
from .identifiers import free_names as free_names
from .interpreter import Interpreter as Interpreter
from .methods import is_method as is_method
from .values import Caller as Caller, Function as Function, wrap_function as wrap_function

"""Names in an expression."""

import ast
import warnings


def free_names(text: str) -> frozenset[str]:
    """Return all names in an expression, including those that its own loops and lambdas bind.

    Raises:
        SyntaxError: it is not an expression.
    """
    with warnings.catch_warnings():  # "1or 2" is legal, but Python warns
        warnings.simplefilter("ignore", SyntaxWarning)
        tree = ast.parse(text.strip(), "<expression>", "eval")
    return frozenset(node.id for node in ast.walk(tree) if isinstance(node, ast.Name))

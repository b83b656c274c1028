"""Names that an expression takes from outside."""

import ast
import warnings


def free_names(text: str) -> frozenset[str]:
    """Return the names of an expression, those that its own loops and lambdas bind among them.

    Raises:
        SyntaxError: it is no expression.
    """
    with warnings.catch_warnings():  # "1or 2" is legal, but Python warns
        warnings.simplefilter("ignore", SyntaxWarning)
        tree = ast.parse(text.strip(), "<expression>", "eval")
    return frozenset(node.id for node in ast.walk(tree) if isinstance(node, ast.Name))

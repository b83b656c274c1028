"""Python expressions on the command line: filters over messages, as for rospy."""

from typing import Any

from trundle.base.diagnostics import UsageError


class Expression:
    """A compiled Python expression."""

    def __init__(self, text: str) -> None:
        """Compile.

        Raises:
            UsageError: the text is not an expression.
        """
        self._text = text
        try:
            self._code = compile(text, "<expression>", "eval")
        except (SyntaxError, ValueError) as error:
            raise UsageError(f"not a Python expression: {text!r}: {error}") from None

    def value(self, **names: Any) -> Any:
        """Evaluate with variables.

        Raises:
            UsageError: evaluation fails.
        """
        try:
            return eval(self._code, names)
        except Exception as error:  # an expression may raise anything
            location = f" on {names['topic']}" if "topic" in names else ""
            raise UsageError(f"{self._text!r} fails{location}: {type(error).__name__}: {error}") from None


def expression(text: str | None) -> Expression | None:
    """Compile an option's value; None if it is None."""
    return None if text is None else Expression(text)

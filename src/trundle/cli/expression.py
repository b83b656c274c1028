"""Python of the person at the keyboard: filters over messages, written as for rospy."""

from typing import Any

from trundle.diagnostics import UsageError


class Expression:
    """A Python expression of a few names."""

    def __init__(self, text: str) -> None:
        """Compile it.

        Raises:
            UsageError: it is no expression.
        """
        self._text = text
        try:
            self._code = compile(text, "<expression>", "eval")
        except (SyntaxError, ValueError) as error:
            raise UsageError(f"not a Python expression: {text!r}: {error}") from None

    def value(self, **names: Any) -> Any:
        """Evaluate it.

        Raises:
            UsageError: it fails.
        """
        try:
            return eval(self._code, names)
        except Exception as error:  # whatever the person at the keyboard wrote
            where = f" on {names['topic']}" if "topic" in names else ""
            raise UsageError(f"{self._text!r} fails{where}: {type(error).__name__}: {error}") from None


def expression(text: str | None) -> Expression | None:
    """Compile what an option holds, if it is given."""
    return None if text is None else Expression(text)

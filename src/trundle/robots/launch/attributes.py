"""Attributes of a launch element: substituted and typed, with `if` and `unless` evaluated."""

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.base.xmlnode import XmlNode

from .scope import Scope
from .substitution import Substitution
from .values import read_flag

_NODES_OF_AN_ELEMENT = 5
"""XML nodes that count for a substituted element in the reading budget."""


class Attributes:
    """Attributes of one element; unknown ones are reported and ignored."""

    def __init__(
        self, node: XmlNode, scope: Scope, substitution: Substitution, report: Diagnostics, known: tuple[str, ...]
    ) -> None:
        self.node = node
        self.at: Source = node.at
        self._scope = scope
        self._substitution = substitution
        self.count_values(_NODES_OF_AN_ELEMENT)
        self.is_active = self._evaluate_if_unless()
        """True if `if` and `unless` keep the element; otherwise none of its other attributes may be read."""
        if self.is_active:
            for name in node.attributes():
                if name not in known and name not in ("if", "unless"):
                    report.warn(
                        self.at,
                        f"attribute {name!r} of <{node.tag}> is not known; it is ignored",
                        "unsupported-attribute",
                    )

    def _evaluate_if_unless(self) -> bool:
        condition, negated = self.text("if"), self.text("unless")
        if condition is not None and negated is not None:
            raise DescriptionError(self.at, f"<{self.node.tag}>: either 'if' or 'unless', not both", "launch-condition")
        try:
            if condition is not None:
                return read_flag(condition)
            return negated is None or not read_flag(negated)
        except ValueError as error:
            raise DescriptionError(
                self.at, f"<{self.node.tag}> {'unless' if condition is None else 'if'}: {error}", "launch-condition"
            ) from None

    def count_values(self, count: int) -> None:
        """Count values read for this element.

        Raises:
            ReadBudgetError: the budget is exhausted.
        """
        self._substitution.files.budget.add_nodes(count, self.at)

    def text(self, name: str) -> str | None:
        """Attribute after substitution; None if absent."""
        value = self.node.attribute(name)
        return None if value is None else self.resolve(value)

    def resolve(self, text: str) -> str:
        """Substitute a text of this element.

        Raises:
            MissingPackageError: an element other than <arg> needs a missing package.
        """
        resolved = self._substitution.resolve(text, self._scope, self.at)
        if self.node.tag != "arg":
            self._substitution.refuse_missing(resolved, self.at)
        return resolved

    def read_file(self, name: str) -> bytes:
        """Read a file that an attribute names.

        Raises:
            DescriptionError: the file may not be read, or its package is missing.
            ValueError: the file does not exist or cannot be read.
        """
        self._substitution.refuse_absent(name, self.at)
        return self._substitution.files.read(name, self.at)

    def required(self, name: str, *, empty: bool = False) -> str:
        """Required attribute after substitution.

        Raises:
            DescriptionError: the attribute is absent, or empty without `empty`.
        """
        value = self.text(name)
        if value is None or not (value or empty):
            raise DescriptionError(self.at, f"<{self.node.tag}> needs the attribute {name!r}", "missing-attribute")
        return value

    def flag(self, name: str) -> bool:
        """True or false in any case; absent is false.

        Raises:
            DescriptionError: another value; 1 and 0 are invalid, unlike in `if`, as in roslaunch.
        """
        value = self.text(name)
        if value is None or value.lower() == "false":
            return False
        if value.lower() == "true":
            return True
        raise DescriptionError(
            self.at, f"<{self.node.tag}> {name}: {value!r} is neither 'true' nor 'false'", "launch-value"
        )

    def number(self, name: str, *, default: float) -> float:
        """Number, or `default` if absent."""
        value = self.text(name)
        try:
            return default if value is None else float(value)
        except ValueError:
            raise DescriptionError(
                self.at, f"<{self.node.tag}> {name}: {value!r} is not a number", "launch-value"
            ) from None

    def namespace(self) -> str | None:
        """Attribute `ns`, or None.

        Raises:
            DescriptionError: the namespace is empty or private.
        """
        value = self.text("ns")
        if value == "":
            raise DescriptionError(
                self.at, f"<{self.node.tag}> has an empty 'ns'; leave it out to stay in this one", "launch-namespace"
            )
        if value is not None and value.startswith("~"):
            raise DescriptionError(
                self.at, f"<{self.node.tag}> ns {value!r}: a namespace cannot be private", "launch-namespace"
            )
        return value

"""The attributes of one launch element: substituted, typed, with `if` and `unless` decided."""

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.xmlnode import XmlNode

from .scope import Scope
from .substitution import Substitution
from .values import read_flag


class Attributes:
    """Reads attributes of an element; those that are not known are named once, and ignored."""

    def __init__(
        self, node: XmlNode, scope: Scope, substitution: Substitution, report: Diagnostics, known: tuple[str, ...]
    ) -> None:
        self.node = node
        self.at: Source = node.at
        self._scope = scope
        self._substitution = substitution
        self.is_active = self._evaluate_if_unless()
        """Whether `if` and `unless` let the element count; nothing else of it may be looked at where they do not."""
        if self.is_active:
            for name in node.attributes():
                if name not in known and name not in ("if", "unless"):
                    report.warn(self.at, f"attribute {name!r} of <{node.tag}> is not known; it is ignored")

    def _evaluate_if_unless(self) -> bool:
        wanted, unwanted = self.text("if"), self.text("unless")
        if wanted is not None and unwanted is not None:
            raise DescriptionError(self.at, f"<{self.node.tag}>: either 'if' or 'unless', not both")
        try:
            if wanted is not None:
                return read_flag(wanted)
            return unwanted is None or not read_flag(unwanted)
        except ValueError as error:
            raise DescriptionError(
                self.at, f"<{self.node.tag}> {'unless' if wanted is None else 'if'}: {error}"
            ) from None

    def text(self, name: str) -> str | None:
        """An attribute after substitution, or None where it is absent."""
        value = self.node.attribute(name)
        return None if value is None else self.resolve(value)

    def resolve(self, text: str) -> str:
        """Replace the substitutions of a text that belongs to this element."""
        return self._substitution.resolve(text, self._scope, self.at)

    def required(self, name: str, *, empty: bool = False) -> str:
        """An attribute that must be there.

        Raises:
            DescriptionError: absent, or empty where that is not allowed.
        """
        value = self.text(name)
        if value is None or not (value or empty):
            raise DescriptionError(self.at, f"<{self.node.tag}> needs the attribute {name!r}")
        return value

    def flag(self, name: str) -> bool:
        """True or false, any case; absent is false.

        Raises:
            DescriptionError: anything else; unlike `if`, roslaunch takes no 1 or 0 here.
        """
        value = self.text(name)
        if value is None or value.lower() == "false":
            return False
        if value.lower() == "true":
            return True
        raise DescriptionError(self.at, f"<{self.node.tag}> {name}: {value!r} is neither 'true' nor 'false'")

    def number(self, name: str, *, default: float) -> float:
        """A number; absent is the default."""
        value = self.text(name)
        try:
            return default if value is None else float(value)
        except ValueError:
            raise DescriptionError(self.at, f"<{self.node.tag}> {name}: {value!r} is not a number") from None

    def namespace(self) -> str | None:
        """The attribute `ns`, or None.

        Raises:
            DescriptionError: present and empty, or private.
        """
        value = self.text("ns")
        if value == "":
            raise DescriptionError(self.at, f"<{self.node.tag}> has an empty 'ns'; leave it out to stay in this one")
        if value is not None and value.startswith("~"):
            raise DescriptionError(self.at, f"<{self.node.tag}> ns {value!r}: a namespace belongs to no single node")
        return value

"""Names that `dir` and completion list for the objects that users hold: those of the reference."""

from collections.abc import Callable
from typing import TypeVar

_Class = TypeVar("_Class", bound=type)


def documented(names: str) -> Callable[[_Class], _Class]:
    """Decorate a class whose objects list what the reference documents, without what other rooms call.

    Args:
        names: public members, separated by spaces; those of a base class with such a list are added.
    """

    def decorate(cls: _Class) -> _Class:
        listed = frozenset(names.split()).union(*(vars(base).get("_documented", ()) for base in cls.__mro__))

        def listing(self: object) -> list[str]:
            return sorted(listed | {name for name in object.__dir__(self) if name.startswith("_")})

        setattr(cls, "_documented", listed)  # noqa: B010  # pyright knows no such attribute of a type
        setattr(cls, "__dir__", listing)  # noqa: B010
        return cls

    return decorate

"""Migration rules: one step from a message type to the next.

Rule files subclass `MessageUpdateRule`; its interface is that of rosbag.
"""

from collections.abc import Sequence
from io import BytesIO
from typing import Any, ClassVar, Protocol

from ..errors import RosError
from .classes import MessageClass, MessageClasses, RuleMessage


class MigrationError(RosError):
    """A rule file or rule that cannot be used, or messages without a rule."""


class Rules(Protocol):
    """Interface of the migrator that rules use."""

    is_forced: bool

    def rules_between(self, old: MessageClass, new: MessageClass) -> "list[Rule]":
        """Rules that lead from one class to another."""
        ...

    def convert(self, old: RuleMessage, new: MessageClass) -> RuleMessage:
        """Convert a message."""
        ...

    def warn(self, text: str, /) -> None:
        """Log a warning."""
        ...


class Rule:
    """One step from a class to the next."""

    old_type: str = ""
    new_type: str = ""
    migrated_types: Sequence[tuple[str, str]] = ()
    """(old, new) pairs of nested types that `update` migrates by their own rules; packages may be omitted."""
    order: int = -1
    """Position among the rules of a type."""
    valid: bool = False
    """True if `update` is complete."""
    old_class: MessageClass
    new_class: MessageClass | None
    old_types: dict[str, MessageClass]
    new_types: dict[str, MessageClass]

    def __init__(self, migrator: Rules, location: str) -> None:
        self.migrator = migrator
        self.location = location
        self.sub_rules: list[Rule] = []
        self.sub_rules_valid = False

    @property
    def renames(self) -> bool:
        """True if the rule renames the type."""
        return self.old_type != self.new_type

    def find_sub_paths(self, *, warns: bool = True) -> None:
        """Find the rules of the nested types."""
        self.sub_rules, self.sub_rules_valid = [], True
        for old_name, new_name in self.migrated_types:
            try:
                old, new = self.get_old_class(old_name), self.get_new_class(new_name)
            except KeyError as error:
                self.migrator.warn(f"{self.location}: migrated_types names {error}, which is not in the type's text")
                self.sub_rules_valid = False
                continue
            # A pair of types equal to the rule's own needs no other rules.
            if self.new_class is None or (old.key, new.key) != (self.old_class.key, self.new_class.key):
                self.sub_rules += self.migrator.rules_between(old, new)
            if not all(rule.valid for rule in self.sub_rules):
                if warns:
                    self.migrator.warn(f"{self.location}: no rules lead from {old_name} to {new_name} yet")
                self.sub_rules_valid = False

    def get_old_class(self, name: str) -> MessageClass:
        """Class of a nested type of the old message."""
        return _class(self.old_types, self.old_type, name)

    def get_new_class(self, name: str) -> MessageClass:
        """Class of a nested type of the new message."""
        return _class(self.new_types, self.new_type, name)

    def migrate(self, old: Any, new: Any) -> None:
        """Migrate a nested message.

        Raises:
            MigrationError: its types are not in `migrated_types`, or no rules lead from one to the other.
        """
        self._check_listed(old._type, new._type)
        new_class = type(new) if isinstance(new, RuleMessage) else self.get_new_class(new._type)
        _assign(new, self.migrator.convert(old, new_class))

    def migrate_array(self, old: Sequence[Any], new: list[Any], new_name: str) -> None:
        """Migrate a list of nested messages; `new` is overwritten.

        Raises:
            MigrationError: see `migrate`.
        """
        new_class = self.get_new_class(new_name)
        del new[:]
        for message in old:
            self._check_listed(message._type, new_class.kind)
            new.append(self.migrator.convert(message, new_class))

    def apply(self, old: RuleMessage) -> RuleMessage:
        """Convert a message.

        Raises:
            MigrationError: the rule is not complete.
        """
        if self.new_class is None or not (self.valid or self.migrator.is_forced):
            raise MigrationError(f"{self.location}: the rule is not complete")
        new = self.new_class()
        self.update(old, new)
        return new

    def update(self, old_msg: Any, new_msg: Any) -> None:
        """Fill the new message from the old one; implemented by each rule."""
        raise NotImplementedError

    def _check_listed(self, old: str, new: str) -> None:
        pair = short_name(old, self.old_type), short_name(new, self.new_type)
        if pair not in {(first, second) for first, second in self.migrated_types}:
            raise MigrationError(f"{pair} is not in migrated_types")


class MessageUpdateRule(Rule):
    """Base class of rules in rule files: definitions of both types, and `update`."""

    old_full_text: ClassVar[str] = ""
    new_full_text: ClassVar[str] = ""

    def __init__(self, migrator: Rules, location: str) -> None:
        """Create the classes of both definitions.

        Raises:
            MessageError: a definition is invalid.
        """
        super().__init__(migrator, location)
        self.old_types = MessageClasses.from_definition(self.old_type, self.old_full_text).nested_classes(self.old_type)
        self.new_types = MessageClasses.from_definition(self.new_type, self.new_full_text).nested_classes(self.new_type)
        self.old_class, self.new_class = self.old_types[self.old_type], self.new_types[self.new_type]


def short_name(name: str, outer_type: str) -> str:
    """Nested type name as in rules: without std_msgs and without the outer type's package."""
    parts = name.split("/")
    for omitted in ("std_msgs", outer_type.partition("/")[0]):
        if omitted in parts:
            parts.remove(omitted)
    return "/".join(parts)


def _class(types: dict[str, MessageClass], outer_type: str, name: str) -> MessageClass:
    package = outer_type.partition("/")[0]
    for full in (name, f"std_msgs/{name}", f"{package}/{name}"):
        if full in types:
            return types[full]
    raise KeyError(name)


def _assign(target: Any, source: RuleMessage) -> None:
    """Copy a message to one of the same type, of this module or of genpy."""
    if isinstance(target, RuleMessage):
        for name in type(target).kinds:
            setattr(target, name, getattr(source, name))
        return
    buffer = BytesIO()
    source.serialize(buffer)
    target.deserialize(buffer.getvalue())

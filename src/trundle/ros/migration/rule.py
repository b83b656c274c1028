"""Rules that bring a message of one type up to the next.

`MessageUpdateRule` is what rule files derive from; its names are those of rosbag, whose rule files run here.
"""

from collections.abc import Sequence
from io import BytesIO
from typing import Any, ClassVar, Protocol

from ..errors import RosError
from .classes import MessageClass, MessageClasses, RuleMessage


class MigrationError(RosError):
    """A rule file or rule that cannot be used, or messages that no rule brings up to date."""


class Rules(Protocol):
    """What a rule asks of the migrator it belongs to."""

    is_forced: bool

    def rules_between(self, old: MessageClass, new: MessageClass) -> "list[Rule]":
        """The rules that lead from one class to another."""
        ...

    def convert(self, old: RuleMessage, new: MessageClass) -> RuleMessage:
        """Lead a message through them."""
        ...

    def warn(self, text: str, /) -> None:
        """Say what may not work."""
        ...


class Rule:
    """One step from a class to the next."""

    old_type: str = ""
    new_type: str = ""
    migrated_types: Sequence[tuple[str, str]] = ()
    """Pairs of types within, old and new, that `update` leads on to their own rules; packages may be left out."""
    order: int = -1
    """Place among the rules of a type."""
    valid: bool = False
    """Whether `update` is complete."""
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
        """Whether the type has another name afterwards."""
        return self.old_type != self.new_type

    def find_sub_paths(self, *, is_told: bool = True) -> None:
        """Find the rules for the types within."""
        self.sub_rules, self.sub_rules_valid = [], True
        for old_name, new_name in self.migrated_types:
            try:
                old, new = self.get_old_class(old_name), self.get_new_class(new_name)
            except KeyError as error:
                self.migrator.warn(f"{self.location}: migrated_types names {error}, which is not in the type's text")
                self.sub_rules_valid = False
                continue
            # A rule may name its own type, where the sums are known to match.
            if self.new_class is None or (old.key, new.key) != (self.old_class.key, self.new_class.key):
                self.sub_rules += self.migrator.rules_between(old, new)
            if not all(rule.valid for rule in self.sub_rules):
                if is_told:
                    self.migrator.warn(f"{self.location}: no rules lead from {old_name} to {new_name} yet")
                self.sub_rules_valid = False

    def get_old_class(self, name: str) -> MessageClass:
        """The class of a type within the old one."""
        return _class(self.old_types, self.old_type, name)

    def get_new_class(self, name: str) -> MessageClass:
        """The class of a type within the new one."""
        return _class(self.new_types, self.new_type, name)

    def migrate(self, old: Any, new: Any) -> None:
        """Bring a message within up to date.

        Raises:
            MigrationError: its types are not in `migrated_types`, or no rules lead from one to the other.
        """
        self._check_listed(old._type, new._type)
        made = type(new) if isinstance(new, RuleMessage) else self.get_new_class(new._type)
        _assign(new, self.migrator.convert(old, made))

    def migrate_array(self, old: Sequence[Any], new: list[Any], new_name: str) -> None:
        """Bring a list of messages within up to date; what the new one holds is replaced.

        Raises:
            MigrationError: as `migrate`.
        """
        made = self.get_new_class(new_name)
        del new[:]
        for each in old:
            self._check_listed(each._type, made.kind)
            new.append(self.migrator.convert(each, made))

    def apply(self, old: RuleMessage) -> RuleMessage:
        """Make the new message.

        Raises:
            MigrationError: the rule is not complete.
        """
        if self.new_class is None or not (self.valid or self.migrator.is_forced):
            raise MigrationError(f"{self.location}: the rule is not complete")
        new = self.new_class()
        self.update(old, new)
        return new

    def update(self, old_msg: Any, new_msg: Any) -> None:
        """Fill the new message from the old one; each rule has its own."""
        raise NotImplementedError

    def _check_listed(self, old: str, new: str) -> None:
        pair = short_name(old, self.old_type), short_name(new, self.new_type)
        if pair not in {(first, second) for first, second in self.migrated_types}:
            raise MigrationError(f"{pair} is not in migrated_types")


class MessageUpdateRule(Rule):
    """A rule as a rule file has it: texts of the types, and `update`."""

    old_full_text: ClassVar[str] = ""
    new_full_text: ClassVar[str] = ""

    def __init__(self, migrator: Rules, location: str) -> None:
        """Make the classes of both texts.

        Raises:
            MessageError: a text cannot be read.
        """
        super().__init__(migrator, location)
        self.old_types = MessageClasses.from_definition(self.old_type, self.old_full_text).nested_classes(self.old_type)
        self.new_types = MessageClasses.from_definition(self.new_type, self.new_full_text).nested_classes(self.new_type)
        self.old_class, self.new_class = self.old_types[self.old_type], self.new_types[self.new_type]


def short_name(name: str, of: str) -> str:
    """A type within another as rules write it: without std_msgs, and without the other's own package."""
    parts = name.split("/")
    for left_out in ("std_msgs", of.partition("/")[0]):
        if left_out in parts:
            parts.remove(left_out)
    return "/".join(parts)


def _class(types: dict[str, MessageClass], of: str, name: str) -> MessageClass:
    package = of.partition("/")[0]
    for full in (name, f"std_msgs/{name}", f"{package}/{name}"):
        if full in types:
            return types[full]
    raise KeyError(name)


def _assign(target: Any, source: RuleMessage) -> None:
    """Make a message, one of ours or of genpy's, equal to another of its type."""
    if isinstance(target, RuleMessage):
        for name in type(target).kinds:
            setattr(target, name, getattr(source, name))
        return
    buffer = BytesIO()
    source.serialize(buffer)
    target.deserialize(buffer.getvalue())

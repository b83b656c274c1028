"""Common parts of `trundle bag check` and `fix`: rules, and the migration of each type in a bag."""

import os
import sys
from dataclasses import dataclass
from pathlib import Path

from trundle.ros import (
    BagConnection,
    BagReader,
    MessageClass,
    MessageClasses,
    MessageError,
    Messages,
    MigrationStep,
    Migrator,
    Rule,
    RuleFile,
    missing_rules,
)


@dataclass(frozen=True, slots=True)
class Migration:
    """Migration of one connection's messages to the known type."""

    old: MessageClass
    new: MessageClass | None
    """Class of the known type; None if the type is unknown."""
    path: list[MigrationStep]
    missing: list[Rule]

    def lines(self) -> list[str]:
        """Return the lines in rosbag's format."""
        lines = transition(self.path[0].old, self.path[-1].new, indent=0)
        if self.missing:
            lines.append(f"    {len(self.missing)} rules missing:")
            for rule in self.missing:
                lines += transition(rule.old_class, rule.new_class, indent=1)
        return lines


def load_rules(files: list[str], *, with_plugins: bool, is_forced: bool = False) -> Migrator:
    """Load the given rule files, and those that packages export, whose paths are printed.

    Raises:
        MigrationError: a file is invalid.
    """
    rules = [RuleFile(Path(name)) for name in files]
    if with_plugins:
        from trundle.robots.packages import Packages, exported_rules

        # Not from the working directory: reading a bag must not run code beside it.
        for package, path in exported_rules(Packages(os.environ, start=Path(os.sep)).ros_packages()):
            print(f"Using the rules of package {package}: {path}", file=sys.stderr)
            rules.append(RuleFile(path))
    return Migrator(rules, Messages(), warn=_warn, is_forced=is_forced)


def migrations(bag: BagReader, rules: Migrator) -> dict[BagConnection, Migration]:
    """Return the migration of each connection, in the order of first messages."""
    result: dict[BagConnection, Migration] = {}
    pending = set(bag.connections)
    for message in bag.messages(pending.__contains__):
        connection = message.connection
        if connection in pending:
            pending.remove(connection)
            result[connection] = _migration(connection, rules)
            if not pending:
                break
    return result


def unmigrated_types(plan: dict[BagConnection, Migration]) -> list[Migration]:
    """Return the migrations of changed types, one per type."""
    by_type = {(step.old.kind, step.old.md5sum): step for step in reversed(plan.values()) if step.path}
    return list(reversed(by_type.values()))


def transition(old: MessageClass, new: MessageClass | None, *, indent: int) -> list[str]:
    """Return the old and new type in rosbag's format."""
    space = "    " * indent
    to = "Unknown" if new is None else f"{new.kind} [{new.md5sum}]"
    return [f"{space} * From: {old.kind} [{old.md5sum}]", f"{space}   To:   {to}"]


def _migration(connection: BagConnection, rules: Migrator) -> Migration:
    known = rules.known_class(connection.type)
    try:
        old = MessageClasses.from_definition(connection.type, connection.definition).message_class(connection.type)
    except MessageError:
        if known is None or known.md5sum != connection.md5sum:
            raise
        old = known  # the recorded definition is missing or invalid
    new = rules.target(old)
    path = rules.path(old, new)
    return Migration(old, new, path, missing_rules([step.rule for step in path]))


def _warn(text: str) -> None:
    print(f"WARNING: {text}", file=sys.stderr)

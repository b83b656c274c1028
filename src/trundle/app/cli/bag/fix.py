"""`trundle bag fix`: migrates the messages of a bag to the known types."""

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.ros import BagConnection, BagMessage, BagReader, Migrator, open_bag, replaced_bag

from .rules import Migration, load_rules, migrations, unmigrated_types

Convert = Callable[[bytes], bytes]


def main(args: argparse.Namespace) -> int:
    """Write a bag with all messages migrated to the known types."""
    source, target = Path(args.inbag), Path(args.outbag)
    if target.suffix not in (".bag", ".mcap"):
        return args.refuse(f"Output file must be a bag file, not {target.name}")
    if source.resolve() == target.resolve():
        raise UsageError(f"Cannot use same file as input and output [{source}]")
    with open_bag(source) as bag:
        rules = load_rules(args.rules, with_plugins=not args.noplugins, is_forced=args.force)
        plan = migrations(bag, rules)
        impossible = [migration for migration in unmigrated_types(plan) if migration.missing]
        if impossible and not args.force:
            print("Bag could not be migrated.  The following migrations could not be performed:")
            for migration in impossible:
                print("\n".join(migration.lines()))
            print(
                "Try running 'bag check' to create the necessary rule files or run 'bag fix' with the '--force' option."
            )
            return 1
        _write(bag, target, {connection: _plan(connection, step, rules) for connection, step in plan.items()})
    print("Bag migrated successfully.")
    return 0


def encrypt(args: argparse.Namespace) -> int:
    """Refuse, with alternatives."""
    del args
    raise UsageError(
        "encryption of bags is not supported: rosbag's plugin needs GnuPG keys of its own; encrypt the file, "
        "as with gpg -e drive.bag or age -e, and decrypt it before playing; only rosbag decrypts its own"
    )


def _write(bag: BagReader, target: Path, plans: dict[BagConnection, tuple[BagConnection, Convert]]) -> None:
    with replaced_bag(target) as out:
        for message in bag.messages():
            connection, convert = plans[message.connection]
            out.write(BagMessage(connection, message.stamp_ns, convert(message.data)))


def _plan(connection: BagConnection, migration: Migration, rules: Migrator) -> tuple[BagConnection, Convert]:
    """Return the output's connection and converter; messages of unknown types stay unchanged."""
    old, new = migration.old, migration.new
    if new is None:
        return connection, lambda data: data
    if not migration.path:
        return replace(connection, md5sum=old.md5sum), lambda data: data
    written = replace(connection, type=new.kind, md5sum=new.md5sum, definition=new.definition)
    return written, lambda data: rules.convert_bytes(data, old, new)

"""`trundle bag fix`: bags of old message types, brought up to the types known here."""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from trundle.diagnostics import UsageError
from trundle.ros import BagConnection, BagMessage, BagReader, MessageError, Messages, create_bag, open_bag

Migration = Callable[[bytes], bytes]


def main(args: argparse.Namespace) -> int:
    """Write a bag in which every message is of the type that its name means here."""
    source, target = Path(args.inbag), Path(args.outbag)
    if target.suffix not in (".bag", ".mcap"):
        return args.refuse(f"Output file must be a bag file, not {target.name}")
    if args.rules:
        raise UsageError(
            f"{args.rules[0]}: rule files are programs for rosbag's own migrator and are not run here; fields of the "
            "same name are carried over without them, and --force leaves the others out"
        )
    if source.resolve() == target.resolve():
        raise UsageError(f"Cannot use same file as input and output [{source}]")
    with open_bag(source) as bag:
        known = Messages()
        problems: list[str] = []
        plans = {c: _plan(c, known, problems) for c in bag.connections}
        if problems and not args.force:
            print("Bag could not be migrated.  The following migrations could not be performed:")
            print("\n".join(dict.fromkeys(problems)))
            print("Run trundle bag fix with --force to leave new fields at 0 and lose those that are gone.")
            return 1
        _write(bag, target, plans)
    print("Bag migrated successfully.")
    return 0


def encrypt(args: argparse.Namespace) -> int:
    """Say that there is no such thing."""
    del args
    raise UsageError(
        "bags are not encrypted here: rosbag's plugin needs GnuPG keys of its own; encrypt the file, "
        "as with gpg -e drive.bag or age -e, and decrypt it before playing; what rosbag encrypted, it alone decrypts"
    )


def _write(bag: BagReader, target: Path, plans: dict[BagConnection, tuple[BagConnection, Migration] | None]) -> None:
    working = target.with_name(f"{target.stem}.part{target.suffix}")
    working.unlink(missing_ok=True)
    try:
        with create_bag(working) as out:
            for message in bag.messages():
                plan = plans[message.connection]
                if plan is not None:
                    message = BagMessage(plan[0], message.stamp_ns, plan[1](message.data))
                out.write(message)
        working.replace(target)
    finally:
        working.unlink(missing_ok=True)


def _plan(connection: BagConnection, known: Messages, problems: list[str]) -> tuple[BagConnection, Migration] | None:
    """How messages of a connection become those of today; None where they are already, or their type is unknown."""
    kind = connection.type
    if not known.has(kind) or known.md5(kind) == connection.md5sum:
        return None
    old = Messages(bare=True)
    old.add_definition(kind, connection.definition)
    differences = list(_differences(old, known, kind))
    if differences:
        problems.append(f" * From: {kind} [{connection.md5sum}]\n   To:   {kind} [{known.md5(kind)}]")
        problems.extend(f"     {difference}" for difference in differences)

    def migrate(data: bytes) -> bytes:
        message = old.deserialize(data, kind)
        return bytes(known.serialize(known.new(kind, _fields(message, kind, old, known))))

    new = replace(connection, md5sum=known.md5(kind), definition=known.definition(kind))
    return new, migrate


def _differences(old: Messages, new: Messages, kind: str, where: str = "") -> Iterator[str]:
    """Name each field that only one of two types has, or that means something else, here or within."""
    before, after = old.fields(kind), new.fields(kind)
    for name, field in after.items():
        path = f"{where}{name}"
        if name not in before:
            yield f"{path} ({field}) is new"
        elif before[name] != field:
            yield f"{path} was {before[name]} and is {field}"
        elif _is_message(field, new):
            yield from _differences(old, new, field.partition("[")[0], f"{path}.")
    for name in before.keys() - after.keys():
        yield f"{where}{name} ({before[name]}) is gone"


def _is_message(field: str, messages: Messages) -> bool:
    return "/" in field and messages.has(field.partition("[")[0])


def _fields(message: Any, kind: str, old: Messages, new: Messages) -> dict[str, Any]:
    """What both types have of a message."""
    before, after = old.fields(kind), new.fields(kind)
    both = {name: field for name, field in after.items() if before.get(name) == field}
    return {name: _value(_get(message, name), field, old, new) for name, field in both.items()}


def _value(value: Any, field: str, old: Messages, new: Messages) -> Any:
    kind = field.partition("[")[0]
    if kind in ("time", "duration"):
        stamps = value if isinstance(value, list) else [value]
        made = [{"secs": stamp.sec, "nsecs": stamp.nanosec} for stamp in stamps]
        return made if isinstance(value, list) else made[0]
    if not _is_message(field, new):
        return value
    if isinstance(value, list):
        return [_fields(item, kind, old, new) for item in value]
    return _fields(value, kind, old, new)


def _get(message: Any, name: str) -> Any:
    """A field; rosbags appends `_` to one named like a Python keyword."""
    try:
        return getattr(message, name) if hasattr(message, name) else getattr(message, f"{name}_")
    except AttributeError:
        raise MessageError(f"a message has no field {name!r}") from None

"""`trundle bag check`: reports types that changed since a bag was recorded, and writes rules to migrate them."""

import argparse
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.ros import GeneratedRule, Migrator, PlaceholderRule, Rule, missing_rules, open_bag

from .rules import load_rules, migrations, transition, unmigrated_types


def main(args: argparse.Namespace) -> int:
    """Print the migrations that a bag needs, and write missing rules."""
    if refusal := _refusal(args):
        return args.refuse(refusal)
    with open_bag(Path(args.bag)) as bag:
        rules = load_rules([*args.rules, *([args.genrules] if args.append else [])], with_plugins=not args.noplugins)
        unmigrated = unmigrated_types(migrations(bag, rules))
    if not unmigrated:
        print("Bag file does not need any migrations.")
        return 0
    print("The following migrations need to occur:")
    for migration in unmigrated:
        print("\n".join(migration.lines()))
    missing = [rule for migration in unmigrated for rule in migration.missing]
    if args.genrules is None:
        if missing:
            print("\nTo generate rules, please run with -g <rulefile>")
        else:
            print("\nAll rules defined.  Bag is ready to be migrated")
        return 1
    if not missing:
        print(f"\nNo additional rule files needed to be generated.  {args.genrules} not created.")
        return 0
    texts = _texts(missing, rules)
    with Path(args.genrules).open("a", encoding="utf-8") as file:
        file.writelines(texts)
    print(f"\nThe necessary rule files have been written to: {args.genrules}")
    return 0


def _refusal(args: argparse.Namespace) -> str:
    if args.genrules is None:
        return "Cannot specify -a without also specifying -g." if args.append else ""
    exists = Path(args.genrules).is_file()
    if exists and not args.append:
        return f"The file {args.genrules} already exists.  Include -a if you intend to append."
    if args.append and not exists:
        return f"The file {args.genrules} does not exist, and so -a is invalid."
    return ""


def _texts(missing: list[Rule], rules: Migrator) -> list[str]:
    """Return the Python source of each rule to complete; ask the user for the new names of moved types."""
    texts: dict[str, None] = {}
    pending = list(missing)
    for rule in pending:
        if isinstance(rule, PlaceholderRule):
            completed = _completed(rule, rules)
            print(f"Creating the migration rule for {completed.new_type} requires additional missing rules:")
            new_rules = [rule for rule in missing_rules(completed.sub_rules) if rule not in pending]
            for new_rule in new_rules:
                print("\n".join(transition(new_rule.old_class, new_rule.new_class, indent=1)))
            pending += new_rules
            rule = completed
        if isinstance(rule, GeneratedRule):
            texts[rule.text()] = None
    return list(texts)


def _completed(rule: PlaceholderRule, rules: Migrator) -> GeneratedRule:
    kind = rule.old_class.kind
    print(f"The message type {kind} appears to have moved.  Please enter the type to migrate it to.")
    while True:
        try:
            name = input(">").strip()
        except EOFError:
            raise UsageError(f"no type was entered to migrate {kind} to; no rules are written") from None
        completed = rules.rule_to_complete(rule, name)
        if completed is not None:
            return completed
        print(f"'{name}' could not be found in your system.  Please make sure it is built.")

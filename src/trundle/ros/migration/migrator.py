"""Finds and applies the rules that lead from a recorded type to the known one."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import Any

from ..messages.message_library import Messages
from .chains import Chains
from .classes import Key, MessageClass, MessageClasses, RuleMessage, from_bytes, to_bytes
from .generated import GeneratedRule, PlaceholderRule
from .rule import MessageUpdateRule, MigrationError, Rule
from .rule_files import RuleFile, rule_errors


@dataclass(slots=True, eq=False)
class MigrationStep:
    """A rule between two classes, and the next step."""

    old: MessageClass
    new: MessageClass | None
    """None if the next type is unknown."""
    rule: Rule
    next: "MigrationStep | None" = None


class Migrator:
    """All rules of rule files, and generated ones between them."""

    def __init__(
        self,
        files: Iterable[RuleFile],
        known: Messages,
        *,
        warn: Callable[[str], None],
        is_forced: bool = False,
    ) -> None:
        """Link the rules.

        Args:
            files: loaded rule files.
            known: target types.
            warn: called with each rule conflict.
            is_forced: True: apply incomplete rules; new fields stay 0, removed fields are lost.

        Raises:
            MigrationError: a rule is marked invalid, or its definitions are.
        """
        self.warn = warn
        self.is_forced = is_forced
        self._known = MessageClasses(known)
        self._first: dict[str, MigrationStep] = {}
        self._paths: dict[tuple[Key, Key | None], list[MigrationStep]] = {}
        self._chains = Chains(warn)
        for file in files:
            for rule in file.rules(self):
                self._chains.add(rule)
        self._link()

    def known_class(self, kind: str) -> MessageClass | None:
        """Class of a known type; None if the type is unknown."""
        return self._known.message_class(kind) if self._known.has(kind) else None

    def target(self, old: MessageClass) -> MessageClass | None:
        """Known class that a recorded type migrates to: of the same name, or of the name to which rules rename it."""
        known = self.known_class(old.kind)
        step = self._first.get(old.kind)
        if known is not None or step is None:
            return known
        while step.next is not None:
            step = step.next
        return None if step.new is None else self.known_class(step.new.kind)

    def path(self, old: MessageClass, new: MessageClass | None) -> list[MigrationStep]:
        """Steps from one class to another, missing ones included; empty if they are equivalent."""
        key = old.key, None if new is None else new.key
        if key not in self._paths:
            self._paths[key] = self._find(old, new)
        return self._paths[key]

    def rule_to_complete(self, rule: PlaceholderRule, kind: str) -> GeneratedRule | None:
        """Rule for the user to complete, from an unmatched type to the known type `kind`; None if `kind` is unknown."""
        known = self.known_class(kind)
        return None if known is None else self._generated_with_sub_rules(rule.old_class, known)

    def convert_bytes(self, data: bytes, old: MessageClass, new: MessageClass) -> bytes:
        """Convert a serialized message from one class to another.

        Raises:
            MigrationError: rules are missing, or one fails.
            MessageError: the data is not a message of class `old`.
        """
        path = self._can_migrate(old, new)
        if not path or old.md5sum == new.md5sum:
            return data
        message = _apply_path(path, from_bytes(path[0].old, data))
        with rule_errors(path[-1].rule):
            return to_bytes(message)

    def convert(self, old: RuleMessage, new: MessageClass) -> RuleMessage:
        """See `Rules`."""
        path = self._can_migrate(type(old), new)
        if path and type(old).md5sum != new.md5sum:
            return _apply_path(path, old)
        return from_bytes(new, to_bytes(old))

    def rules_between(self, old: MessageClass, new: MessageClass) -> list[Rule]:
        """See `Rules`."""
        return [step.rule for step in self.path(old, new)]

    def _can_migrate(self, old: MessageClass, new: MessageClass) -> list[MigrationStep]:
        path = self.path(old, new)
        if not self.is_forced and not all(step.rule.valid for step in path):
            raise MigrationError(f"no complete rules lead from {old.kind} [{old.md5sum}] to {new.kind}")
        return path

    # -- linking

    def _link(self) -> None:
        """Link the rules of each type to each other, to the rules of its later names, and to the known types."""
        steps: list[MigrationStep] = []
        last_steps: list[MigrationStep] = []
        for kind, chain in self._chains.items():
            last: MigrationStep | None = None
            for rule in chain.all_rules():
                step = MigrationStep(rule.old_class, rule.new_class, rule)
                if last is None:
                    self._first[kind] = step
                else:
                    assert last.new is not None
                    last.next = step
                    if last.new.key != step.old.key:
                        last.next = MigrationStep(last.new, step.old, self._generated(last.new, step.old), step)
                        steps.append(last.next)
                steps.append(step)
                last = step
            if last is not None:
                last_steps.append(last)
        for last in last_steps:
            last.next = self._after(last)
            steps += [last.next] if last.next else []
        for step in dict.fromkeys(steps):
            step.rule.find_sub_paths(warns=isinstance(step.rule, MessageUpdateRule))

    def _after(self, last: MigrationStep) -> MigrationStep | None:
        """Step after a type's last rule: the latest reachable rule of its new name."""
        assert last.new is not None
        known = self.known_class(last.new.kind)
        if known is not None and known.key == last.new.key:
            return None
        to_known = None if known is None else MigrationStep(last.new, known, self._generated(last.new, known))
        is_renamed = last.old.kind != last.new.kind
        later = self._range(last.new.kind, last.new.kind) if is_renamed else []
        for step in reversed(later):
            if step.old.key == last.new.key:
                return step
        if to_known is not None and (to_known.rule.valid or (is_renamed and not later)):
            return to_known
        for step in reversed(later):
            rule = self._generated(last.new, step.old)
            if rule.valid:
                return MigrationStep(last.new, step.old, rule, step)
        return MigrationStep(last.new, None, PlaceholderRule(self, last.new) if to_known is None else to_known.rule)

    def _range(self, old_type: str, new_type: str) -> list[MigrationStep]:
        """Steps from the first rule of a type to the last rule that ends in another type."""
        step = self._first.get(old_type)
        steps = [] if step is None else [step]
        has_reached_new = False
        while step is not None and step.next is not None and step.next.new is not None:
            step = step.next
            steps.append(step)
            assert step.new is not None
            is_new = step.new.kind == new_type
            if has_reached_new and not is_new:
                break
            has_reached_new |= is_new
        return steps

    # -- paths

    def _find(self, old: MessageClass, new: MessageClass | None) -> list[MigrationStep]:
        if new is None:
            return self._path_to_unknown(old)
        if old.key == new.key:
            return []
        steps = self._range(old.kind, new.kind)
        return self._from_old(self._to_new(steps, new), old, new) if steps else [self._step(old, new)]

    def _to_new(self, steps: list[MigrationStep], new: MessageClass) -> list[MigrationStep]:
        """Steps up to the last class from which a rule leads to `new`, and this rule."""
        ends = list(takewhile(lambda i: _type(steps[i].new) == new.kind, reversed(range(len(steps)))))
        for i in ends:
            if _key(steps[i].new) == new.key:
                return steps[: i + 1]
        for i in ends:
            step = self._step(steps[i].new, new)
            if _is_complete(step):
                return [*steps[: i + 1], step]
        return [*steps, self._step(steps[-1].new, new)]

    def _from_old(self, steps: list[MigrationStep], old: MessageClass, new: MessageClass) -> list[MigrationStep]:
        """Steps from the last class that a rule from `old` leads to, and this rule before them."""
        starts = [i for i in reversed(range(len(steps))) if steps[i].old.kind == old.kind]
        for i in starts:
            if steps[i].old.key == old.key:
                return steps[i:]
        step = self._step(old, new)
        if _is_complete(step):
            return [step]
        for i in starts:
            step = self._step(old, steps[i].old)
            if _is_complete(step):
                return [step, *steps[i:]]
        return [self._step(old, steps[0].old), *steps]

    def _path_to_unknown(self, old: MessageClass) -> list[MigrationStep]:
        """Steps from a class without a known target, as far as rules lead."""
        steps = self._range(old.kind, "")
        for i in reversed(range(len(steps))):
            if steps[i].old.key == old.key:
                steps = steps[i:]
                break
        else:
            for i in reversed(range(len(steps))):
                if steps[i].old.kind == old.kind and (step := self._step(old, steps[i].old)).rule.valid:
                    steps = [step, *steps[i:]]
                    break
        last = steps[-1].new if steps else old
        assert last is not None
        return [*steps, MigrationStep(last, None, PlaceholderRule(self, last))]

    def _step(self, old: MessageClass | None, new: MessageClass) -> MigrationStep:
        assert old is not None
        return MigrationStep(old, new, self._generated_with_sub_rules(old, new))

    def _generated_with_sub_rules(self, old: MessageClass, new: MessageClass) -> GeneratedRule:
        rule = self._generated(old, new)
        rule.find_sub_paths(warns=False)
        return rule

    def _generated(self, old: MessageClass, new: MessageClass) -> GeneratedRule:
        return GeneratedRule(self, old, new, lambda a, b: b in self._chains.later_names(a))


def missing_rules(rules: Sequence[Rule]) -> list[Rule]:
    """Rules to complete among `rules` and their sub-rules, each once."""
    missing: dict[tuple[Key, Key | None], Rule] = {}
    pending = list(rules)
    while pending:
        rule = pending.pop(0)
        if not rule.valid:
            missing.setdefault((rule.old_class.key, _key(rule.new_class)), rule)
        pending = [*rule.sub_rules, *pending]
    return list(missing.values())


def _apply_path(path: Sequence[MigrationStep], message: Any) -> Any:
    for step in path:
        with rule_errors(step.rule):
            message = step.rule.apply(message)
    return message


def _is_complete(step: MigrationStep) -> bool:
    return step.rule.valid and step.rule.sub_rules_valid


def _type(message_class: MessageClass | None) -> str:
    return "" if message_class is None else message_class.kind


def _key(message_class: MessageClass | None) -> Key | None:
    return None if message_class is None else message_class.key

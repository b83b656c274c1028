"""Migration rules per type in order; the last may rename the type."""

from collections.abc import Callable
from dataclasses import dataclass, field

from .rule import MessageUpdateRule


@dataclass(slots=True)
class Chain:
    """Rules of one type."""

    updates: list[MessageUpdateRule] = field(default_factory=list[MessageUpdateRule])
    """Rules that keep the type's name, sorted by `order`."""
    rename: MessageUpdateRule | None = None
    """Last rule, which renames the type."""

    def all_rules(self) -> list[MessageUpdateRule]:
        """All rules in order."""
        return [*self.updates, *([self.rename] if self.rename else [])]


class Chains:
    """Rule chains by initial type."""

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._chains: dict[str, Chain] = {}

    def add(self, rule: MessageUpdateRule) -> None:
        """Add a rule, unless it contradicts an earlier one, which is logged."""
        chain = self._chains.setdefault(rule.old_type, Chain())
        conflict = self._rename_conflict(chain, rule) if rule.renames else _update_conflict(chain, rule)
        if conflict:
            self._warn(f"{rule.location}: {conflict}; this rule is ignored")
        elif rule.renames:
            chain.rename = rule
        else:
            chain.updates = sorted([*chain.updates, rule], key=lambda update: update.order)

    def items(self) -> list[tuple[str, Chain]]:
        """Types with their chains, in the order of their first rule."""
        return list(self._chains.items())

    def later_names(self, kind: str) -> set[str]:
        """All names of a type: its own, and those that rules rename it to, transitively."""
        names = {kind}
        chain = self._chains.get(kind)
        while chain is not None and chain.rename is not None:
            names.add(chain.rename.new_type)
            chain = self._chains.get(chain.rename.new_type)
        return names

    def _rename_conflict(self, chain: Chain, rule: MessageUpdateRule) -> str:
        if chain.rename is not None:
            return f"{chain.rename.location} renames {rule.old_type} already"
        if rule.old_type in self.later_names(rule.new_type):
            return f"{rule.new_type} is renamed back to {rule.old_type}"
        if chain.updates and rule.order <= chain.updates[-1].order:
            return (
                f"a rule that renames comes last, but {chain.updates[-1].location} has order {chain.updates[-1].order}"
            )
        return ""


def _update_conflict(chain: Chain, rule: MessageUpdateRule) -> str:
    for other in chain.updates:
        if other.order == rule.order:
            return f"{other.location} has order {rule.order} already"
    if chain.rename is not None and rule.order >= chain.rename.order:
        return f"{chain.rename.location} renames {rule.old_type} at order {chain.rename.order}, before this one"
    return ""

"""One line of `trundle doctor`."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

State: TypeAlias = Literal["ok", "missing", "problem"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """Result of one check."""

    name: str
    state: State
    """missing: an optional part is missing; problem: something does not work."""
    found: str
    """Version, path, number or state."""
    cost: str = ""
    """Consequence and remedy; empty if all is well."""

    def as_json(self) -> dict[str, str]:
        """Return the fields as `doctor --json` prints them."""
        return {"name": self.name, "state": self.state, "found": self.found, "cost": self.cost}


def table(checks: list[Check]) -> str:
    """Return the checks as columns: state, name, finding; the consequence is on the next line."""
    width = max(len(check.name) for check in checks)
    lines: list[str] = []
    for check in checks:
        lines.append(f"{check.state:<8} {check.name:<{width}}  {check.found}")
        if check.cost:
            lines.append(f"{'':8} {'':{width}}  → {check.cost}")
    return "\n".join(lines)

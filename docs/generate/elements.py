"""References of SDF and URDF: each element and attribute, and what Trundle does with it."""

from collections.abc import Sequence

from .element_inventory import HERE, Inventory, read_inventory
from .element_spec import Spec, read_spec
from .markdown import code, html, table

_INTRO = """# {format} elements

The elements and attributes of {format} with type, unit and default, and what Trundle does with each:

- **read**: it has its effect.
- **no effect**: `trundle check` says why, as an info.
- **not supported**: a warning with file and line ([`unsupported-element`](diagnostics.md#unsupported-element)); the
  element is ignored with all that is in it, so that its parts are not listed.

An element that no table lists is a warning, too. Below each table is an example of the element with its defaults.
{more}
"""
_MORE = {
    "sdf": """
The column *since* names the version of SDF that introduced an element, and the last one that has it. Trundle reads
versions 1.0 to 1.12. A default that changed depends on the version that the file states. The physical meaning of each
number is in [decision 8](../decisions/0008-where-contacts-differ-from-ode.md).""",
    "urdf": """
A URDF is read by urdfdom's rules and converted to SDF as in Gazebo; the content of a `<gazebo>` block is SDF, see
[SDF elements](sdf.md). Links at a fixed joint are merged, as in Gazebo.""",
}
_HEADINGS = ("element", "type", "unit", "default", "since", "Trundle")
_SAVED = ("state", "model_state", "link_state", "joint_state", "light_state")
"""Tables of the specification about a <state>."""
_WITHOUT_EFFECT = {
    "joint/calibration": "for real hardware",
    "joint/safety_controller@k_velocity": "for ros_control on real hardware",
    "joint/safety_controller@k_position": "for ros_control on real hardware",
}
_CONDITIONS = {
    "is for wide-angle cameras": "read by wide-angle cameras only",
    "does not apply to wide-angle cameras": "read, but not by wide-angle cameras",
}
"""Reason why some sensors do not read an element → what others do."""
_PARAMS = {"robots/description/sdf/params.py"}
"""Reads the names of any element that <experimental:params> may change."""


def page(kind: str) -> str:
    """Return the reference of `sdf` or `urdf`."""
    inventory = read_inventory(HERE / f"every_element.{kind}")
    spec = read_spec(kind)
    named = list(dict.fromkeys(row.section for row in spec))
    sections = [name for name in named if _is_read(name, inventory)]
    parts = [_INTRO.format(format=kind.upper(), more=_MORE[kind])]
    parts += [_section(name, [row for row in spec if row.section == name], inventory, sections) for name in sections]
    parts.append(_others(spec, inventory))
    if unread := [name for name in named if name not in sections]:
        elements = ", ".join(f"`<{name}>`" for name in unread)
        parts.append(f"## Without tables\n\nNothing in these elements is read: {elements}.\n")
    return "\n".join(part for part in parts if part)


def _is_read(name: str, inventory: Inventory) -> bool:
    tables = (inventory.children, inventory.attributes)
    return any(key == name or key.endswith(f"/{name}") or key in _keys(name) for table in tables for key in table)


def _section(name: str, rows: Sequence[Spec], inventory: Inventory, sections: Sequence[str]) -> str:
    shown: list[Spec] = []
    unsupported: list[str] = []
    for row in rows:
        if any(row.element == path or row.path.startswith((f"{path}/", f"{path}@")) for path in unsupported):
            continue
        shown.append(row)
        if not row.attribute and "/" in row.path and treatment(row, inventory) != "read":
            unsupported.append(row.path)
    cells = [_cells(row, name, inventory, sections) for row in shown if row.path != name or row.type]
    if not cells:
        return ""
    example = _example(name, [row for row in shown if not row.until and treatment(row, inventory) == "read"])
    return f"## &lt;{name}&gt; {{ #{name} }}\n\n{table(_HEADINGS, cells)}\n```xml\n{example}\n```\n"


def _cells(row: Spec, section: str, inventory: Inventory, sections: Sequence[str]) -> tuple[str, ...]:
    path = row.path.removeprefix(section).removeprefix("/")
    path = path.replace("@", " @") if "@" in path[1:] else path
    versions = row.since if not row.until else f"{row.since} to {row.until}"
    default = code(row.default) if row.default else ""
    if row.earlier:
        default += f" ({html(row.earlier)})"
    tag = row.path.rpartition("/")[2]
    linked = f'<a href="#{tag}">element</a>' if tag in sections and tag != section else "element"
    words = html(_words(row, inventory))
    return (code(path or section), html(row.type) or linked, html(row.unit), default, html(versions), words)


def _words(row: Spec, inventory: Inventory) -> str:
    kind = treatment(row, inventory)
    reason = _WITHOUT_EFFECT.get(row.path) or _reason(row.element, inventory)
    if kind != "no effect" or reason is None:
        return _CONDITIONS.get(reason or "", kind)
    return reason.removeprefix("has ") if reason.startswith("has no effect") else f"no effect: {reason}"


def _reason(path: str, inventory: Inventory) -> str | None:
    """Return why an element is not used; None: it is, or nothing knows it."""
    parent, _, tag = path.rpartition("/")
    return next((inventory.ignored[key, tag] for key in _keys(parent) if (key, tag) in inventory.ignored), None)


def treatment(row: Spec, inventory: Inventory) -> str:
    """Return `read`, `no effect` or `not supported`."""
    if row.path in _WITHOUT_EFFECT:
        return "no effect"
    if row.attribute:
        names = inventory.attributes
        return "read" if any(row.attribute in names.get(key, {}) for key in _keys(row.element)) else "not supported"
    if "/" not in row.path:
        return "read"
    tag = row.path.rpartition("/")[2]
    parents = _keys(row.path.rpartition("/")[0])
    reason = _reason(row.path, inventory)
    if reason is not None:
        return "read" if reason in _CONDITIONS else "no effect"
    return "read" if any(tag in inventory.children.get(parent, {}) for parent in parents) else "not supported"


def _keys(path: str) -> list[str]:
    """Return the inventory's names of an element: with its parent where the name alone is ambiguous."""
    words = path.split("/")
    if words[0] in _SAVED and (saved := words[-1].removesuffix("_state")) in ("model", "link", "joint", "light"):
        return [f"state/{saved}", words[-1]]
    return ["/".join(words[-2:]), words[-1]] if len(words) > 1 else [words[-1]]


def _example(name: str, rows: Sequence[Spec]) -> str:
    """Return the element with its attributes and with each child that holds a value."""
    attributes = {row.element: [r for r in rows if r.attribute and r.element == row.element] for row in rows}
    lines: list[str] = []
    elements = [row for row in rows if not row.attribute]

    def write(path: str, depth: int) -> None:
        tag = path.rpartition("/")[2]
        named = "".join(f' {r.attribute}="{_value(r)}"' for r in attributes.get(path, []))
        inner = [r.path for r in elements if r.path.rpartition("/")[0] == path and _holds(r, elements, attributes)]
        value = next((_value(r) for r in elements if r.path == path and r.type), "")
        indent = "  " * depth
        if inner:
            lines.append(f"{indent}<{tag}{named}>")
            for child in inner:
                write(child, depth + 1)
            lines.append(f"{indent}</{tag}>")
        else:
            lines.append(f"{indent}<{tag}{named}>{value}</{tag}>" if value else f"{indent}<{tag}{named}/>")

    write(name, 0)
    return "\n".join(lines)


def _holds(row: Spec, elements: Sequence[Spec], attributes: dict[str, list[Spec]]) -> bool:
    """True if an element has a value, attributes or children; others have a table of their own."""
    return bool(
        row.type or attributes.get(row.path) or any(other.path.startswith(f"{row.path}/") for other in elements)
    )


def _value(row: Spec) -> str:
    if row.default:
        return row.default
    number = {"double": "0", "number": "1", "int": "1", "unsigned int": "1", "bool": "true", "three numbers": "1 1 1"}
    first = row.type.partition(",")[0]
    return number.get(row.type) or (
        "0.5 0.5 0.5 1" if "four numbers" in row.type else first if " or " in row.type else "…"
    )


def _others(spec: Sequence[Spec], inventory: Inventory) -> str:
    """Return what Trundle reads beyond the specification."""
    known = {(key, row.element.rpartition("/")[2]) for row in spec for key in _keys(row.element.rpartition("/")[0])}
    known_attributes = {(key, row.attribute) for row in spec if row.attribute for key in _keys(row.element)}
    rows = [
        (code(parent), code(child))
        for parent in inventory.parents
        for child in sorted(inventory.children.get(parent, {}))
        if (parent, child) not in known and child not in {tag for _, tag in inventory.ignored}
    ]
    rows += [
        (code(parent), code(f"@{name}"))
        for parent in inventory.parents
        for name in sorted(inventory.attributes.get(parent, {}))
        if (parent, name) not in known_attributes and inventory.attributes[parent][name] != _PARAMS
    ]
    if not rows:
        return ""
    return "\n".join(["## Beyond the specification", "", "Read as well:", "", table(("in", "element"), rows)])

"""Reader of <experimental:params> in an <include>: changes inside the included model.

Each child names an element of the model by tag and path (`element_id="link::sensor"`) and an action for it or for its
children: add, modify, remove or replace, by the rules of libsdformat's parameter passing.
"""

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode

_OWN = ("element_id", "action")
_ACTIONS = ("add", "modify", "remove", "replace")


def apply_params(include: XmlNode, model: XmlNode, report: Diagnostics) -> None:
    """Change a model's XML before it is read."""
    for params in include.all("experimental:params"):
        for change in params.children:
            path = change.attribute("element_id")
            if path is None:
                report.warn(change.at, f"<{change.tag}> without element_id in <experimental:params>; it is left out")
                continue
            _change(change, model, [name for name in path.split("::") if name], report)


def _change(change: XmlNode, model: XmlNode, path: list[str], report: Diagnostics) -> None:
    action = change.attribute("action")
    if action == "add":
        parent = _element(model, path, None)
        if parent is not None:
            _add(parent, change)
            return
    elif path and (found := _element(model, path, change.tag)) is not None:
        parent = _element(model, path[:-1], None)
        assert parent is not None
        if action is None:
            for part in change.children:
                _change_part(part, found, report)
        else:
            _act(action, change, found, parent, report)
        return
    name = "::".join(path)
    report.warn(change.at, f"<experimental:params>: no <{change.tag}> {name!r} in the included model; it is left out")


def _change_part(change: XmlNode, parent: XmlNode, report: Diagnostics) -> None:
    """Apply one child of a changed element, which has its own action."""
    action = change.attribute("action") or ""
    if action == "add":
        _add(parent, change)
        return
    found = _child(parent, change.tag, change.attribute("name"))
    if found is None:
        report.warn(change.at, f"<experimental:params>: no <{change.tag}> in <{parent.tag}>; it is left out")
    elif action == "remove" and change.children:
        for each in change.children:
            if (lost := _child(found, each.tag, each.attribute("name"))) is not None:
                found.remove(lost)
    else:
        _act(action, change, found, parent, report)


def _act(action: str, change: XmlNode, found: XmlNode, parent: XmlNode, report: Diagnostics) -> None:
    match action:
        case "remove":
            parent.remove(found)
        case "replace":
            parent.remove(found)
            _add(parent, change)
        case "modify":
            _modify(found, change, report)
        case _:
            known = ", ".join(_ACTIONS)
            report.warn(change.at, f"<{change.tag}>: action {action!r} is unknown; actions: {known}; it is left out")


def _add(parent: XmlNode, what: XmlNode) -> None:
    parent.append(what)
    parent.children[-1].drop_attributes(*_OWN)


def _modify(found: XmlNode, change: XmlNode, report: Diagnostics) -> None:
    """Overwrite existing values."""
    found.merge_values(change)
    found.drop_attributes(*_OWN)
    for part in change.children:
        inner = _child(found, part.tag, part.attribute("name"))
        if inner is None:
            report.warn(part.at, f"<experimental:params>: no <{part.tag}> to modify in <{found.tag}>; it is left out")
        else:
            _modify(inner, part, report)


def _element(model: XmlNode, path: list[str], tag: str | None) -> XmlNode | None:
    """Return the element at a path of names; the last one must have the tag."""
    node: XmlNode | None = model
    for i, name in enumerate(path):
        last = i == len(path) - 1
        node = next(
            (
                child
                for child in (node.children if node is not None else [])
                if child.attribute("name") == name and (not last or tag is None or child.tag == tag)
            ),
            None,
        )
    return node


def _child(parent: XmlNode, tag: str, name: str | None) -> XmlNode | None:
    return next(
        (each for each in parent.children if each.tag == tag and name in (None, each.attribute("name"))),
        None,
    )

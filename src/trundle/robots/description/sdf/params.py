"""Reader of <experimental:params> in an <include>: changes inside the included model.

Each child names an element of the model by tag and path (`element_id="link::sensor"`) and an action for it or for its
children: add, modify, remove or replace, by the rules of libsdformat's parameter passing.
"""

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode

_PARAM_ATTRIBUTES = ("element_id", "action")
_ACTIONS = ("add", "modify", "remove", "replace")


def apply_params(include: XmlNode, model: XmlNode, report: Diagnostics) -> None:
    """Change a model's XML before it is read."""
    for params in include.all("experimental:params"):
        for change in params.children:
            path = change.attribute("element_id")
            if path is None:
                report.warn(
                    change.at,
                    f"<{change.tag}> without element_id in <experimental:params>; it is left out",
                    "incomplete-element",
                )
                continue
            _change(change, model, [name for name in path.split("::") if name], report)


def _change(change: XmlNode, model: XmlNode, path: list[str], report: Diagnostics) -> None:
    action = change.attribute("action")
    if action == "add":
        parent = _element(model, path, None)
        if parent is not None:
            _add(parent, change)
            return
    elif path and (element := _element(model, path, change.tag)) is not None:
        parent = _element(model, path[:-1], None)
        assert parent is not None
        if action is None:
            for part in change.children:
                _change_part(part, element, report)
        else:
            _act(action, change, element, parent, report)
        return
    name = "::".join(path)
    report.warn(
        change.at,
        f"<experimental:params>: no <{change.tag}> {name!r} in the included model; it is left out",
        "params-target",
    )


def _change_part(change: XmlNode, parent: XmlNode, report: Diagnostics) -> None:
    """Apply the action of one child of a changed element."""
    action = change.attribute("action") or ""
    if action == "add":
        _add(parent, change)
        return
    element = _child(parent, change.tag, change.attribute("name"))
    if element is None:
        report.warn(
            change.at, f"<experimental:params>: no <{change.tag}> in <{parent.tag}>; it is left out", "params-target"
        )
    elif action == "remove" and change.children:
        for part in change.children:
            if (removed := _child(element, part.tag, part.attribute("name"))) is not None:
                element.remove(removed)
    else:
        _act(action, change, element, parent, report)


def _act(action: str, change: XmlNode, element: XmlNode, parent: XmlNode, report: Diagnostics) -> None:
    match action:
        case "remove":
            parent.remove(element)
        case "replace":
            parent.remove(element)
            _add(parent, change)
        case "modify":
            _modify(element, change, report)
        case _:
            actions = ", ".join(_ACTIONS)
            report.warn(
                change.at,
                f"<{change.tag}>: action {action!r} is unknown; actions: {actions}; it is left out",
                "unknown-choice",
            )


def _add(parent: XmlNode, element: XmlNode) -> None:
    parent.append(element)
    parent.children[-1].drop_attributes(*_PARAM_ATTRIBUTES)


def _modify(element: XmlNode, change: XmlNode, report: Diagnostics) -> None:
    """Overwrite existing values."""
    element.merge_values(change)
    element.drop_attributes(*_PARAM_ATTRIBUTES)
    for part in change.children:
        inner = _child(element, part.tag, part.attribute("name"))
        if inner is None:
            report.warn(
                part.at,
                f"<experimental:params>: no <{part.tag}> to modify in <{element.tag}>; it is left out",
                "params-target",
            )
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
        (child for child in parent.children if child.tag == tag and name in (None, child.attribute("name"))),
        None,
    )

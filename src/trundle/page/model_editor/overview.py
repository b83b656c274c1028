"""Overview of a draft for the client: its parts, their forms, and the findings beside what they concern."""

from typing import Any

from trundle.base.xmlnode import XmlElement
from trundle.page import Part
from trundle.spatial import rpy_from_quaternion

from .draft import Draft
from .field import field_json
from .reader import CheckedModel

Json = dict[str, Any]
_MAX_FINDINGS = 100


def draft_overview(draft: Draft) -> Json:
    """Return the draft without its files."""
    checked = draft.checked
    parts: list[tuple[Part, XmlElement]] = [((), checked.document.model), *checked.document.parts()]
    findings = _findings_by_part(checked, parts)
    pose = draft.world_from_model
    return {
        "name": draft.name,
        "of": draft.of,
        "pose": [*pose.position, *rpy_from_quaternion(pose.quaternion)],
        "undo": draft.undo_title,
        "redo": draft.redo_title,
        "parts": [_part_json(checked, part, element, findings.get(part, [])) for part, element in parts],
    }


def _part_json(checked: CheckedModel, part: Part, element: XmlElement, findings: list[Json]) -> Json:
    link = checked.link(part)
    index = None if link is None else checked.model.links.index(link)
    sections = [
        {"title": section.title, "fields": [field_json(element, field) for field in section.fields]}
        for section in checked.sections(part, element)
        if section.fields
    ]
    return {
        "part": part,
        "tag": element.tag,
        "name": element.get("name") or "",
        "detail": _detail(element),
        "mass": None if link is None else link.inertial.mass,
        "link": index,
        "line": checked.document.line(element),
        "sections": sections,
        "findings": findings,
    }


def _detail(element: XmlElement) -> str:
    if element.tag in ("visual", "collision"):
        geometry = element.find("geometry")
        return next((child.tag for child in geometry.children), "") if geometry else ""
    return element.get("filename") or element.get("type") or ""


def _findings_by_part(checked: CheckedModel, parts: list[tuple[Part, XmlElement]]) -> dict[Part, list[Json]]:
    """Return findings by the innermost part around their line; those without one belong to the model."""
    lines = [(checked.document.line(element), _last_line(checked, element), part) for part, element in parts]
    found: dict[Part, list[Json]] = {}
    for finding in checked.findings[:_MAX_FINDINGS]:
        line = finding.at.line if finding.at.file == "model.sdf" else None
        around = [part for first, last, part in lines if line is not None and first <= line <= last]
        home = max(around, key=len, default=())
        said = {"severity": finding.severity, "text": finding.what, "line": line}
        found.setdefault(home, []).append(said)
    return found


def _last_line(checked: CheckedModel, element: XmlElement) -> int:
    return max([checked.document.line(element), *map(checked.document.line, element.descendants())])

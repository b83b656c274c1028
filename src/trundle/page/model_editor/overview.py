"""Overview of a draft for the client: its parts with their fields and findings."""

from collections.abc import Sequence

from trundle.base.xmlnode import XmlElement
from trundle.page import Part
from trundle.spatial import rpy_from_quaternion

from ..world.draft_info import DraftFinding, DraftInfo, DraftPart, DraftSection
from .draft import Draft
from .field import shown_field
from .reader import CheckedModel

_MAX_FINDINGS = 100


def draft_overview(draft: Draft) -> DraftInfo:
    """Return the draft's overview without its files."""
    checked = draft.checked
    parts: list[tuple[Part, XmlElement]] = [((), checked.document.model), *checked.document.parts()]
    findings = _findings_by_part(checked, parts)
    pose = draft.world_from_model
    return DraftInfo(
        name=draft.name,
        original=draft.original,
        pose=(*pose.position, *rpy_from_quaternion(pose.quaternion)),
        undo=draft.undo_title,
        redo=draft.redo_title,
        parts=tuple(_part(checked, part, element, findings.get(part, ())) for part, element in parts),
    )


def _part(checked: CheckedModel, part: Part, element: XmlElement, findings: Sequence[DraftFinding]) -> DraftPart:
    link = checked.link(part)
    return DraftPart(
        part=part,
        tag=element.tag,
        name=element.get("name") or "",
        detail=_detail(element),
        mass=None if link is None else link.inertial.mass,
        link=None if link is None else checked.model.links.index(link),
        line=checked.document.line(element),
        sections=tuple(
            DraftSection(title=section.title, fields=tuple(shown_field(element, field) for field in section.fields))
            for section in checked.sections(part, element)
            if section.fields
        ),
        findings=tuple(findings),
    )


def _detail(element: XmlElement) -> str:
    if element.tag in ("visual", "collision"):
        geometry = element.find("geometry")
        return next((child.tag for child in geometry.children), "") if geometry else ""
    return element.get("filename") or element.get("type") or ""


def _findings_by_part(checked: CheckedModel, parts: list[tuple[Part, XmlElement]]) -> dict[Part, list[DraftFinding]]:
    """Return findings by the innermost part around their line; findings without a line belong to the model."""
    lines = [(checked.document.line(element), _last_line(checked, element), part) for part, element in parts]
    findings: dict[Part, list[DraftFinding]] = {}
    for finding in checked.findings[:_MAX_FINDINGS]:
        line = finding.at.line if finding.at.file == "model.sdf" else None
        around = [part for first, last, part in lines if line is not None and first <= line <= last]
        innermost = max(around, key=len, default=())
        shown = DraftFinding(severity=finding.severity, text=finding.what, line=line)
        findings.setdefault(innermost, []).append(shown)
    return findings


def _last_line(checked: CheckedModel, element: XmlElement) -> int:
    return max([checked.document.line(element), *map(checked.document.line, element.descendants())])

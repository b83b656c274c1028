"""Draft, a copy of a model being edited, for the page's client: its parts, fields and findings."""

from typing import Literal, TypeAlias

from msgspec import UNSET, Struct, UnsetType

FieldKind: TypeAlias = Literal["text", "number", "vector", "pose", "color", "choice", "flag"]
ShownValue: TypeAlias = str | tuple[float, ...] | bool | None
"""Text, numbers or a flag, by the field's kind; None: the file has no value, or there is no default."""


class FileUrl(Struct, frozen=True, kw_only=True):
    """GLB file."""

    id: str
    """Model's name; `draft`; or empty for the lights of the world itself."""
    url: str


class DraftFinding(Struct, frozen=True, kw_only=True):
    """Error or warning about a part."""

    severity: str
    """`error` or `warning`."""
    text: str
    line: int | None
    """Line of the draft's text."""


class DraftField(Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Value of a part."""

    name: str
    """Path of an element, `inertial/mass`, or of an attribute, `axis/@name`."""
    label: str
    kind: FieldKind
    value: ShownValue
    default: ShownValue
    unit: str = ""
    labels: tuple[str, ...] = ()
    """Names of a vector's components."""
    choices: tuple[str, ...] = ()
    minimum: float | UnsetType = UNSET
    maximum: float | UnsetType = UNSET


class DraftSection(Struct, frozen=True, kw_only=True):
    """Fields under one heading."""

    title: str
    fields: tuple[DraftField, ...]


class DraftPart(Struct, frozen=True, kw_only=True):
    """Element of the model."""

    part: tuple[str, ...]
    """Address by tags and names: ("link", "base", "sensor", "eye"); empty: the model itself."""
    tag: str
    name: str
    detail: str
    """Type, shape or file name."""
    mass: float | None
    """[kg]; None: not a link."""
    link: int | None
    """Index of a link; None: not a link."""
    line: int
    sections: tuple[DraftSection, ...]
    findings: tuple[DraftFinding, ...]


class DraftInfo(Struct, frozen=True, kw_only=True):
    """Model being edited."""

    name: str
    original: str | None
    """Model of the world that it replaces; None: a new model."""
    pose: tuple[float, float, float, float, float, float]
    """x y z [m], roll pitch yaw [rad] of the model in the world."""
    undo: str | None
    """Title of the edit to undo."""
    redo: str | None
    """Title of the edit to redo."""
    folder: str | None = None
    """Folder to offer for saving; None: not writable."""
    files: tuple[FileUrl, ...] = ()
    parts: tuple[DraftPart, ...]
    """The model itself, then its parts in file order."""

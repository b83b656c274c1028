"""Draft, a copy of a model that is edited, as the page's client shows it: its parts, forms and findings."""

from typing import Literal, TypeAlias

from msgspec import UNSET, Struct, UnsetType

FieldKind: TypeAlias = Literal["text", "number", "vector", "pose", "colour", "choice", "flag"]
ShownValue: TypeAlias = str | tuple[float, ...] | bool | None
"""By the kind: text; numbers; true or false. None: the file has none, or there is no default."""


class FileUrl(Struct, frozen=True, kw_only=True):
    """A GLB."""

    id: str
    """Name of a model, `draft`, or empty: lights of the world itself."""
    url: str


class DraftFinding(Struct, frozen=True, kw_only=True):
    """Error or warning about a part."""

    severity: str
    """`error` or `warning`."""
    text: str
    line: int | None
    """Line of the draft's text."""


class DraftField(Struct, frozen=True, kw_only=True, omit_defaults=True):
    """One value of a part."""

    name: str
    """Path of the element, `inertial/mass`; an attribute ends in `@name`."""
    label: str
    kind: FieldKind
    value: ShownValue
    default: ShownValue
    unit: str = ""
    labels: tuple[str, ...] = ()
    """Names of a vector's numbers."""
    choices: tuple[str, ...] = ()
    least: float | UnsetType = UNSET
    most: float | UnsetType = UNSET


class DraftSection(Struct, frozen=True, kw_only=True):
    """Fields below one heading."""

    title: str
    fields: tuple[DraftField, ...]


class DraftPart(Struct, frozen=True, kw_only=True):
    """An element of the model."""

    part: tuple[str, ...]
    """Tags and names from the model down: ("link", "base", "sensor", "eye"); empty: the model itself."""
    tag: str
    name: str
    detail: str
    """Type, shape or file name."""
    mass: float | None
    """[kg]; None: it is no link."""
    link: int | None
    """Number among the links; None: it is none."""
    line: int
    sections: tuple[DraftSection, ...]
    findings: tuple[DraftFinding, ...]


class DraftInfo(Struct, frozen=True, kw_only=True):
    """A model that is edited."""

    name: str
    of: str | None
    """Model of the world that it takes the place of; None: it is a new one."""
    pose: tuple[float, float, float, float, float, float]
    """x y z [m], roll pitch yaw [rad] of the model in the world."""
    undo: str | None
    """Edit that can be undone."""
    redo: str | None
    """Edit that can be done again."""
    folder: str | None = None
    """Folder to offer for saving; None: nothing can be written."""
    files: tuple[FileUrl, ...] = ()
    parts: tuple[DraftPart, ...]
    """The model itself, then what is in it, in the file's order."""

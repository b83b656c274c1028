"""Answers to successful requests; each request lists its types of answers."""

from msgspec import Struct


class Answer(Struct, frozen=True):
    """Base of all answers."""


class Done(Answer, frozen=True):
    """The request was executed."""


DONE = Done()


class SavedFile(Answer, frozen=True, kw_only=True):
    """A file, or a folder with files, was written."""

    file: str
    """Path as requested."""


class SavedWorld(Answer, frozen=True, kw_only=True):
    """A world was written."""

    file: str
    """Path as requested."""
    lost: tuple[str, ...]
    """Parts of the world that are not in the file."""


class WorldText(Answer, frozen=True, kw_only=True):
    """A world as SDF."""

    sdf: str
    lost: tuple[str, ...]
    """Parts of the world that are not in the text."""


class FilesExist(Answer, frozen=True, kw_only=True):
    """Nothing was written: there are files that must not be replaced."""

    exists: str
    """Their names, separated by commas."""


class ReplayPage(Answer, frozen=True, kw_only=True):
    """A replay as a page that needs no server."""

    html: str


class ReplayScene(Answer, frozen=True, kw_only=True):
    """A replay as an animated scene."""

    glb: str
    """Base64 of a GLB."""


class ModelEntry(Struct, frozen=True, kw_only=True):
    """Model that can be inserted."""

    name: str
    """Folder's name."""
    title: str
    description: str
    uploaded: bool


class ModelList(Answer, frozen=True, kw_only=True):
    """Models that can be inserted, uploaded ones first."""

    models: tuple[ModelEntry, ...]


class Inserted(Answer, frozen=True, kw_only=True):
    """A model or light was inserted into the world."""

    name: str
    """Name in the world."""


class CodeQuestion(Answer, frozen=True, kw_only=True):
    """Nothing was inserted: the user must first consent to run the model's code."""

    code: tuple[str, ...]
    """Files of code."""
    consent: str
    """Token that gives consent to this code once."""


class EditedPart(Answer, frozen=True, kw_only=True):
    """The draft was edited."""

    part: tuple[str, ...]
    """Address of the part after the edit; empty: the model itself."""


class PluginOffer(Struct, frozen=True, kw_only=True):
    """Plugin that can be added to a draft."""

    filename: str
    about: str
    """Summary of its documentation."""


class DraftOffers(Answer, frozen=True, kw_only=True):
    """Parts that can be added to a draft."""

    plugins: tuple[PluginOffer, ...]
    sensors: tuple[str, ...]
    """Types."""
    joints: tuple[str, ...]
    """Types."""
    meshes: tuple[str, ...]
    """URIs."""


class DefinitionText(Answer, frozen=True, kw_only=True):
    """Definition of a message type."""

    definition: str
    """Definition with those of all nested types."""

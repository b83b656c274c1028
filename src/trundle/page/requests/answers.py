"""Answers to requests; each request names those that it can get. An error is a sentence, and no answer."""

from msgspec import Struct


class Answer(Struct, frozen=True):
    """Base of all answers."""


class Done(Answer, frozen=True):
    """The request was done."""


DONE = Done()


class SavedFile(Answer, frozen=True, kw_only=True):
    """A file, or a folder with files, was written."""

    file: str
    """Path as it was asked for."""


class SavedWorld(Answer, frozen=True, kw_only=True):
    """A world was written."""

    file: str
    """Path as it was asked for."""
    lost: tuple[str, ...]
    """Parts of the world that the file does not hold."""


class WorldText(Answer, frozen=True, kw_only=True):
    """A world as SDF."""

    sdf: str
    lost: tuple[str, ...]
    """Parts of the world that the text does not hold."""


class FilesExist(Answer, frozen=True, kw_only=True):
    """Nothing was written, as there are files that may not be replaced."""

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
    """A model that can be inserted."""

    name: str
    """Folder's name."""
    title: str
    description: str
    uploaded: bool


class ModelList(Answer, frozen=True, kw_only=True):
    """Models that can be inserted, uploaded ones first."""

    models: tuple[ModelEntry, ...]


class Inserted(Answer, frozen=True, kw_only=True):
    """A model or light was put into the world."""

    name: str
    """Name in the world."""


class CodeQuestion(Answer, frozen=True, kw_only=True):
    """Nothing was inserted: a person has to agree that the model's code is run."""

    code: tuple[str, ...]
    """Files of code."""
    consent: str
    """Word that agrees to this code once."""


class EditedPart(Answer, frozen=True, kw_only=True):
    """The draft was edited."""

    part: tuple[str, ...]
    """Address of the part from now on; empty: the model itself."""


class PluginOffer(Struct, frozen=True, kw_only=True):
    """A plugin that a draft can be given."""

    filename: str
    about: str
    """Sentence on what it does."""


class DraftOffers(Answer, frozen=True, kw_only=True):
    """Parts that a draft can be given."""

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
    """With those of all types in it."""

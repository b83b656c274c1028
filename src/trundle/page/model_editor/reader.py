"""Reading a model being edited: its description, and the findings of `trundle check`."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from trundle.base.diagnostics import Diagnostic, Diagnostics, UsageError
from trundle.gazebo.check.description import check_description
from trundle.robots.description import load_text
from trundle.robots.load_input import Piped
from trundle.robots.model import Model, World, flattened
from trundle.robots.packages import Packages

from .document import ModelDocument
from .parts import ReadModel

_SEVERITIES = ("error", "warning")


@dataclass(frozen=True, slots=True)
class CheckedModel(ReadModel):
    """Document, model and findings."""

    world: World
    """World with only this model."""
    findings: tuple[Diagnostic, ...]
    """Errors and warnings."""


class ModelReader:
    """Reads documents as files of one folder."""

    def __init__(self, packages: Packages, environment: Mapping[str, str], folder: Path) -> None:
        """Create it.

        Args:
            packages: resolves URIs.
            environment: variables that locate plugins.
            folder: folder that relative URIs start from.
        """
        self.packages = packages
        self.folder = folder
        self._environment = environment

    def check(self, text: bytes, name: str) -> CheckedModel:
        """Read and check a document; `name` is the file name in findings.

        Raises:
            DescriptionError: the document cannot be read.
            UsageError: it has several models.
        """
        report = Diagnostics()
        checked = check_description(
            name,
            self._environment,
            packages=self.packages,
            start=self.folder,
            report=report,
            piped=Piped(name, text),
        )
        findings = tuple(finding for finding in report.findings if finding.severity in _SEVERITIES)
        return CheckedModel(ModelDocument(text), _only(checked.flat), checked.flat, findings)

    def read(self, document: ModelDocument) -> ReadModel:
        """Read a document without checking it.

        Raises:
            DescriptionError: the document cannot be read.
        """
        text = document.text()
        loaded = load_text(text, name="model.sdf", folder=self.folder, packages=self.packages, report=Diagnostics())
        return ReadModel(document, _only(flattened(loaded.world)))


def _only(world: World) -> Model:
    if len(world.models) != 1:
        raise UsageError(f"only one model can be edited; this file has {len(world.models)}")
    return world.models[0]

"""Files of a model's folder: model.sdf and model.config."""

import re
from pathlib import Path
from xml.sax.saxutils import escape

from trundle.base.xmlnode import XmlDocument

SDF_FILE = "model.sdf"
CONFIG_FILE = "model.config"


def folder_name(model: str) -> str:
    """Return the name to offer for a model's folder."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", model).strip("_") or "model"


def model_config(text: bytes, name: str) -> bytes:
    """Return the content of model.config for a model's document."""
    version = XmlDocument(text, name=SDF_FILE).root.get("version") or "1.7"
    return (
        '<?xml version="1.0"?>\n<model>\n'
        f"  <name>{escape(name)}</name>\n  <version>1.0</version>\n"
        f'  <sdf version="{version}">{SDF_FILE}</sdf>\n'
        "  <description></description>\n</model>\n"
    ).encode()


def target_files(folder: Path) -> tuple[Path, Path]:
    """Return the paths of model.sdf and model.config in a folder."""
    return folder / SDF_FILE, folder / CONFIG_FILE

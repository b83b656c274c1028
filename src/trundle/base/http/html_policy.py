"""Content security policy of self-contained HTML files: they load nothing, and run only their own script."""

import base64
import hashlib

_COMMON = "default-src 'none'; base-uri 'none'; form-action 'none'; style-src 'unsafe-inline'"


def policy_of_document() -> str:
    """Return the <meta> of a document without scripts, whose images are data: URIs."""
    return _meta(f"{_COMMON}; img-src data:")


def policy_of_viewer(script: str) -> str:
    """Return the <meta> of a document with this inline script only, which may create blob: URIs."""
    sources = "data: blob:"
    return _meta(
        f"{_COMMON}; script-src {inline_hash(script)}; img-src {sources}; media-src {sources}; font-src {sources}; "
        f"connect-src {sources}; worker-src blob:"
    )


def inline_hash(text: str) -> str:
    """Return the source expression of an inline script or style sheet."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _meta(policy: str) -> str:
    return f'<meta http-equiv="Content-Security-Policy" content="{policy}">'

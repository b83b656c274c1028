"""Content security policy of HTML files that open alone: they load nothing, and run their own script only."""

import base64
import hashlib

_COMMON = "default-src 'none'; base-uri 'none'; form-action 'none'; style-src 'unsafe-inline'"


def policy_of_document() -> str:
    """Return the <meta> of a document without scripts; its pictures are data: URIs."""
    return _meta(f"{_COMMON}; img-src data:")


def policy_of_viewer(script: str) -> str:
    """Return the <meta> of a document whose only script is this one, as written there; what it makes are blob: URIs."""
    own = "data: blob:"
    return _meta(
        f"{_COMMON}; script-src {inline_hash(script)}; img-src {own}; media-src {own}; font-src {own}; "
        f"connect-src {own}; worker-src blob:"
    )


def inline_hash(text: str) -> str:
    """Return the source expression of an inline script or style sheet."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _meta(policy: str) -> str:
    return f'<meta http-equiv="Content-Security-Policy" content="{policy}">'

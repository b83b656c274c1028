"""Recording as one HTML file that plays it without Trundle and without a network."""

import base64
import gzip
import re
from collections.abc import Mapping
from html import escape
from string import Template

import msgspec

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.http.html_policy import policy_of_viewer
from trundle.page import REPLAY_FILES

from ..scene_settings import scene_settings
from ..world.manifest import SceneSettings
from .recorded_motion import RecordedMotion, animated_world

_PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
$policy
<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover">
<title>$title</title>
<style>$style</style>
</head>
<body>
<div id="app"></div>
<script type="application/json" id="about">$about</script>
<script type="text/plain" id="world">$world</script>
<script type="module">$script</script>
<script type="text/plain" id="licenses">$licenses</script>
</body>
</html>
""")


class ReplayAbout(msgspec.Struct, frozen=True, kw_only=True):
    """Metadata of the recording in a replay's file."""

    title: str
    start: float
    """Simulated time [s]."""
    end: float
    """Simulated time [s]."""
    scene: SceneSettings
    view: Mapping[str, object] | None
    """Initial view, as in an .rviz file; None: everything that moves is in view."""


def replay_page(motion: RecordedMotion, report: Diagnostics, *, view: Mapping[str, object] | None = None) -> str:
    """Return a recording as HTML.

    Args:
        motion: recorded motion.
        report: receives warnings about shapes that cannot be drawn.
        view: initial view, as in an .rviz file; None: everything that moves is in view.

    Raises:
        UsageError: the viewer is not built.
    """
    try:
        script, style, licenses = (file.read_text(encoding="utf-8") for file in REPLAY_FILES)
    except OSError:
        raise UsageError("the page's client is not built, and a replay contains a part of it: run make") from None
    world = gzip.compress(animated_world(motion, report), mtime=0)
    about = ReplayAbout(
        title=motion.title,
        start=float(motion.times[0]),
        end=float(motion.times[-1]),
        scene=scene_settings(motion.world),
        view=view,
    )
    inert_script = _inert(script)
    return _PAGE.substitute(
        policy=policy_of_viewer(inert_script),
        title=escape(motion.title),
        style=style,
        about=msgspec.json.encode(about).decode().replace("<", "\\u003c"),
        world=base64.b64encode(world).decode(),
        script=inert_script,
        licenses=_inert(licenses),
    )


def _inert(text: str) -> str:
    """Escape a script or text so that nothing in it ends the surrounding element."""
    return re.sub("<(/script|!--)", r"\\x3C\1", text, flags=re.IGNORECASE)

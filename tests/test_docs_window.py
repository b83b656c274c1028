"""The table of Gazebo's and MuJoCo's windows has an answer for each of their entries."""

import re
from pathlib import Path

PAGE = Path(__file__).parents[1] / "docs" / "howto" / "window.md"
ENTRIES = {
    "Gazebo's menus": """
        Save World, Save World As|Save Configuration|Clone World|Quit|Reset Model Poses|Reset World|Building Editor|
        Model Editor|Terrain Editor|Orthographic, Perspective|FPS View Control|Orbit View Control|Reset View Angle|
        Transparent|Wireframe|Collisions|Joints|Center of Mass|Inertias|Contacts|Link Frames|Skeletons|Grid|
        World Origin|Topic Visualization|Plot|Log Data|GUI Overlays|Show Toolbars|Full Screen|Oculus Rift|Hotkey Chart|
        About""",
    "Gazebo's tool bar": """
        Selection|Translation|Rotation|Scale|Undo, Redo with histories|Box, Sphere, Cylinder|
        Point, Spot, Directional Light|Copy, Paste|Align|Snap|View angle|Screenshot|Log|Record video|
        X, Y, Z while moving|Ctrl while moving|Shift while moving""",
    "Gazebo's right click": "Move To|Follow|Edit model|Apply Force/Torque|View of one model|Copy, Paste|Delete",
    "Gazebo's panels": """
        World: GUI|World: Scene|World: Spherical Coordinates|World: Physics|World: Atmosphere|World: Wind|World: Models|
        World: Lights|Insert|Layers|Joint Control|Pause, Play|Step|Real Time Factor, Sim Time|
        Real Time, Iterations, FPS|Reset Time|Playback|Topic viewer|Plot window|Model Editor: parts and joints|
        Model Editor: Save, Exit|Building Editor: walls, levels, floor plans""",
    "MuJoCo's viewer": """
        Space, →, ←|Backspace, Ctrl L|Tab, F1|double click|Ctrl right drag, Ctrl left drag|
        Ctrl right double click, right double click|[ and ]|file: save xml, copy state|
        simulation: noise, keyframes, history|physics|rendering flags|group enable|joint sliders, control sliders|
        sensor graph|profiler, info overlay""",
}
"""Entries of each window, by the heading of their table."""


def test_each_entry_has_an_answer() -> None:
    found: dict[str, list[str]] = {}
    heading = ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            heading = line.removeprefix("## ")
        elif (row := re.fullmatch(r"\| (.+?) \| (.+) \|", line)) and row[2] != "Here":
            found.setdefault(heading, []).append(row[1])
            assert len(row[2]) > 5, f"{row[1]} has no answer"

    expected = {heading: [entry.strip() for entry in text.split("|")] for heading, text in ENTRIES.items()}
    assert found == expected

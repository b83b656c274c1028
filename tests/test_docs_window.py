"""The tables of Gazebo's and MuJoCo's windows have an answer for each entry."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "howto" / "window.md"
ENTRIES = {
    "Gazebo's menus": """
        Save World, Save World As|Save Configuration|Clone World|Quit|Reset Model Poses|Reset World|Building Editor|
        Model Editor|Terrain Editor|Orthographic, Perspective|FPS View Control|Orbit View Control|Reset View Angle|
        Transparent|Wireframe|Collisions|Joints|Center of Mass|Inertias|Contacts|Link Frames|Skeletons|Grid|
        World Origin|Topic Visualization|Plot|Log Data|GUI Overlays|Show Toolbars|Full Screen|Oculus Rift|Hotkey Chart|
        About""",
    "Gazebo's tool bar": """
        Selection|Translation|Rotation|Scale|Undo, Redo with histories|Box, Sphere, Cylinder|
        Point, Spot, Directional Light|Copy, Paste|Align|Snap|View angle|Screenshot|Log, Plot|Record video|
        X, Y, Z while moving|Ctrl while moving|Shift while moving""",
    "Gazebo's right click": "Move To|Follow|Edit model|Apply Force/Torque|View of one model|Copy, Paste|Delete",
    "Gazebo's panels": """
        World: GUI|World: Scene|World: Spherical Coordinates|World: Physics|World: Atmosphere|World: Wind|World: Models|
        World: Lights|Insert|Layers|Joint Control|Pause, Play|Step|Real Time Factor, Sim Time|
        Real Time, Iterations, FPS|Reset Time|Playback|Topic viewer|Plot window|Model Editor: parts and joints|
        Model Editor: inspectors|Model Editor: custom meshes|Model Editor: schematic view|Model Editor: nested models|
        Model Editor: Save, Exit|Building Editor: walls, levels, floor plans""",
    "MuJoCo's viewer": """
        Space, →, ←|Backspace, Ctrl L|Tab, F1|double click|Ctrl right drag, Ctrl left drag|
        Ctrl right double click, right double click|[ and ]|file: save xml, copy state|
        simulation: noise, keyframes, history|physics|rendering flags|option, visualization|group enable|
        joint sliders, control sliders|sensor graph|profiler, info overlay""",
}
"""Entries of each window, by the heading of their table."""


def test_each_entry_has_an_answer() -> None:
    entries: dict[str, list[str]] = {}
    heading = ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            heading = line.removeprefix("## ")
        elif (row := re.fullmatch(r"\| (.+?) \| (.+) \|", line)) and row[2] != "Here":
            entries.setdefault(heading, []).append(row[1])
            assert len(row[2]) > 5, f"{row[1]} has no answer"

    expected = {heading: [entry.strip() for entry in text.split("|")] for heading, text in ENTRIES.items()}
    assert entries == expected


def test_commands_named_on_the_page_exist() -> None:
    sources = (file.read_text(encoding="utf-8").lower() for file in (ROOT / "web/src").rglob("*.ts*"))
    strings = {string for source in sources for string in re.findall(r'"[^"\n]*"', source)}
    named = re.findall(r"(?<![*\w])\*([^*\n]+)\*", PAGE.read_text(encoding="utf-8"))
    starts = re.compile(r"Open |Show or hide |Look from (?:the )?")
    assert len(named) > 50
    assert [name for name in named if not {f'"{name.lower()}"', f'"{starts.sub("", name).lower()}"'} & strings] == []

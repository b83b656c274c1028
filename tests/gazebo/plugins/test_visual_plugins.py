"""Visual plugins are loaded like model plugins."""

from pathlib import Path

from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

GEOMETRY = "<geometry><sphere><radius>0.1</radius></sphere></geometry>"
MARK = """from trundle.gazebo.plugins import VisualPlugin

class Mark(VisualPlugin):
    @classmethod
    def load(cls, sim, model, link, visual, node, tag):
        mark = cls()
        mark.says = f"{model.name} {link.name} {visual.name} {tag.node.string('says')}"
        return mark

    def before_step(self, sim):
        sim.lines[self.says] = None
"""


def visual(name: str, filename: str) -> str:
    tag = f'<plugin name="p" filename="{filename}"><says>{name}</says></plugin>'
    return f'<visual name="{name}">{GEOMETRY}{tag}</visual>'


def test_a_user_visual_plugin_runs_for_each_of_its_visuals(tmp_path: Path) -> None:
    (tmp_path / "mark.py").write_text(MARK)
    body = f'<link name="l">{BODY.format(1)}{visual("a", "libmark.so")}{visual("b", "libmark.so")}</link>'
    sim = load(tmp_path, body, node=FakeNode())
    sim.step()

    assert list(sim.lines) == ["m l a a", "m l b b"]
    sim.delete("m")
    sim.lines.clear()
    sim.step()
    assert sim.lines == {}


def test_missing_misplaced_and_cosmetic_visual_plugins_are_reported(tmp_path: Path) -> None:
    cosmetic = visual("b", "libBlinkVisualPlugin.so")
    misplaced = visual("c", "libWindPlugin.so")
    sim = load(tmp_path, f'<link name="l">{BODY.format(1)}{visual("a", "libx.so")}{cosmetic}{misplaced}</link>')

    assert [(finding.severity, finding.what) for finding in sim.report.findings] == [
        (
            "warning",
            f"plugin 'p': no libx.so; Trundle runs C++ of its kit and Python: looked for x.py in {tmp_path}; "
            "the run goes on without it",
        ),
        ("info", "plugin 'p': libBlinkVisualPlugin.so alters only how Gazebo draws a visual; it is not run"),
        (
            "warning",
            "plugin 'p' (libWindPlugin.so) is a world's; it belongs into a <world>; the run goes on without it",
        ),
    ]

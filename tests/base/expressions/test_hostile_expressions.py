"""Commands that read a file never run code in it."""

from pathlib import Path

import pytest

from trundle.app.cli import main

_XACRO = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="marker" value="{marker}"/>
{body}<link name="base"/></robot>"""
_LAUNCH = """<launch><param name="x" value="$(eval {text})"/></launch>"""

_RUN = "['__import__']('os').system('touch {marker}')"
_FRAME = "(lambda h: [h.append((h[0].gi_frame{back}.f_builtins for _ in [1])), list(h[0])[0]{run}][1])([])"
_FRAMES = [_FRAME.format(back=".f_back" * count, run=_RUN) for count in range(8)]
"""A generator's frame leads to its callers' frames, one of which has the builtins."""
_PAYLOADS = [
    *_FRAMES,
    "__import__('os').system('touch {marker}')",
    "().__class__.__base__.__subclasses__()",
    "'{{0.gi_frame.f_back.f_builtins}}'.format(x for x in [1])",
    "xacro.load_yaml.__globals__",
]


def _write_file(folder: Path, kind: str, payload: str, marker: Path) -> Path:
    text = payload.format(marker=marker).replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    if kind == "launch":
        file = folder / "x.launch"
        file.write_text(_LAUNCH.format(text=text))
        return file
    body = {
        "attribute": f'<a b="${{{text}}}"/>',
        "condition": f'<xacro:if value="${{{text}}}"/>',
        "property": f'<xacro:property name="p" value="${{{text}}}" lazy_eval="false"/>',
        "default": f'<xacro:macro name="m" params="p:=${{{text}}}"><b/></xacro:macro><xacro:m/>',
        "angle": "<a b=\"${xacro.load_yaml('x.yaml')}\"/>",
    }[kind]
    (folder / "x.yaml").write_text(f"a: !degrees {payload.format(marker=marker)!r}\n")
    file = folder / "x.urdf.xacro"
    file.write_text(_XACRO.format(body=body, marker=marker))
    return file


@pytest.mark.parametrize("kind", ["attribute", "condition", "property", "default", "angle", "launch"])
def test_reading_a_hostile_file_runs_no_code(tmp_path: Path, kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    marker = tmp_path / "marker"
    for payload in _PAYLOADS:
        file = str(_write_file(tmp_path, kind, payload, marker))
        for command in (
            ["check", file],
            ["xacro", file],
            ["convert", file, "--to", "sdf"],
            ["render", file, "-o", "x.png"],
        ):
            if kind == "launch" and command[0] != "check":
                continue
            assert main(command) == 1
            assert not marker.exists(), (payload, command)
            lines = "".join(capsys.readouterr()).splitlines()
            assert any(": error: " in line for line in lines)
            assert not any("Traceback" in line for line in lines)

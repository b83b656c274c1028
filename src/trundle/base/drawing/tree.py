"""Trees, such as kinematic or tf trees, as text or SVG.

Iterative throughout, so that the depth is unlimited.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from html import escape

_ROW, _INDENT, _HEIGHT, _CHARACTER = 30, 36, 22, 7.2
"""Row height, indentation, box height, character width [px]."""


@dataclass(slots=True)
class TreeNode:
    """Labelled node with children."""

    label: str
    edge: str = ""
    """Label of the edge to the parent."""
    children: list["TreeNode"] = field(default_factory=list["TreeNode"])


def tree_text(roots: Sequence[TreeNode]) -> str:
    """Draw trees with lines, one node per row.

    base
    ├─ wheel  (hinge: revolute)
    └─ head   (neck: fixed)
    """
    lines: list[str] = []
    for node, lasts in _walk(roots):
        stem = "".join("   " if last else "│  " for last in lasts[1:-1])
        branch = "" if len(lasts) == 1 else "└─ " if lasts[-1] else "├─ "
        lines.append(f"{stem}{branch}{node.label}{f'  ({node.edge})' if node.edge else ''}")
    return "\n".join(lines)


def tree_svg(roots: Sequence[TreeNode], *, title: str) -> str:
    """Draw trees as an SVG document: boxes in file order from top to bottom, connected by right-angled lines."""
    boxes: list[str] = []
    lines: list[str] = []
    rows_above: list[int] = []
    width = 0.0
    rows = 0
    for row, (node, lasts) in enumerate(_walk(roots)):
        depth = len(lasts) - 1
        del rows_above[depth:]
        x, y = 12 + depth * _INDENT, 12 + row * _ROW
        box_width = len(node.label) * _CHARACTER + 16
        boxes.append(f'<rect x="{x}" y="{y}" width="{box_width:g}" height="{_HEIGHT}" rx="5"/>')
        boxes.append(f'<text x="{x + 8}" y="{y + 15}">{escape(node.label)}</text>')
        if node.edge:
            boxes.append(f'<text class="edge" x="{x + box_width + 8:g}" y="{y + 15}">{escape(node.edge)}</text>')
        if depth:
            stem, top = x - _INDENT + 14, 12 + rows_above[-1] * _ROW + _HEIGHT
            lines.append(f'<path d="M{stem} {top}V{y + _HEIGHT // 2}H{x}"/>')
        rows_above.append(row)
        width = max(width, x + box_width + 8 + len(node.edge) * _CHARACTER)
        rows = row + 1
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 12:g}" height="{rows * _ROW + 16}">\n'
        f"<title>{escape(title)}</title>\n"
        "<style>text{font:12px monospace;fill:#1d2733}.edge{fill:#6b7a8c}"
        "rect{fill:#eef3f8;stroke:#7a90a8}path{fill:none;stroke:#7a90a8}</style>\n"
        '<rect width="100%" height="100%" style="fill:#fff;stroke:none"/>\n'
        + "\n".join([*lines, *boxes])
        + "\n</svg>\n"
    )


def _walk(roots: Sequence[TreeNode]) -> Iterator[tuple[TreeNode, tuple[bool, ...]]]:
    """Yield every node in preorder, with a flag per level: True for the last sibling."""
    stack = [(root, (i == len(roots) - 1,)) for i, root in enumerate(roots)][::-1]
    while stack:
        node, lasts = stack.pop()
        yield node, lasts
        children = [(child, (*lasts, i == len(node.children) - 1)) for i, child in enumerate(node.children)]
        stack += children[::-1]

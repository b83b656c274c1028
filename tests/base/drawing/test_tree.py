"""Trees as text and as SVG."""

from trundle.base.drawing.tree import TreeNode, tree_svg, tree_text
from trundle.base.xmlnode import parse_xml

BASE = TreeNode(
    "base",
    children=[
        TreeNode("arm", "shoulder: revolute", [TreeNode("hand <left>", "wrist: fixed")]),
        TreeNode("head", "neck: fixed"),
    ],
)


def test_tree_text_has_connecting_lines() -> None:
    assert tree_text([BASE]).splitlines() == [
        "base",
        "├─ arm  (shoulder: revolute)",
        "│  └─ hand <left>  (wrist: fixed)",
        "└─ head  (neck: fixed)",
    ]


def test_tree_svg_has_a_box_per_node_and_a_line_per_edge() -> None:
    picture = parse_xml(tree_svg([BASE], title="a & b"), name="tree.svg")

    assert len(picture.all("path")) == 3
    texts = [text.text for text in picture.all("text")]
    assert [text for text in texts if ":" not in text] == ["base", "arm", "hand <left>", "head"]


def test_deep_trees_are_drawn_without_recursion() -> None:
    top = last = TreeNode("0")
    for i in range(1, 3000):
        last.children.append(TreeNode(str(i)))
        last = last.children[0]

    assert tree_text([top]).count("\n") == 2999
    assert tree_svg([top], title="chain").count("<path") == 2999

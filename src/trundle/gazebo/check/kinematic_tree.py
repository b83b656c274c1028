"""Kinematic trees of a description: links as nodes, joints as edges."""

from trundle.base.drawing.tree import TreeNode
from trundle.robots.description import LoadedDescription
from trundle.robots.model import Joint, Model, flattened
from trundle.robots.robot import Robot


def kinematic_trees(loaded: LoadedDescription) -> list[TreeNode]:
    """Return one tree for a URDF as written; for SDF, one per model with its free links below it."""
    if loaded.robot is not None:
        return [_robot_tree(loaded.robot)]
    return [_model_tree(model) for model in flattened(loaded.world).models]


def _robot_tree(robot: Robot) -> TreeNode:
    nodes = {link.name: TreeNode(link.name) for link in robot.links}
    for joint in robot.joints:
        child = nodes[joint.child]
        child.edge = f"{joint.name}: {joint.type}"
        nodes.setdefault(joint.parent, TreeNode(joint.parent)).children.append(child)
    return nodes[robot.root]


def _model_tree(model: Model) -> TreeNode:
    root = TreeNode(model.name, edge="static model" if model.static else "model")
    nodes = {link.name: TreeNode(link.name) for link in model.links}
    parents: dict[str, str] = {}
    for joint in model.joints:
        if joint.child not in nodes:
            continue
        if joint.child in parents or _is_below(joint.parent, joint.child, parents):
            loop = TreeNode(joint.child, edge=f"{_edge(joint)}, closes a loop")
            nodes.get(joint.parent, root).children.append(loop)
            continue
        parents[joint.child] = joint.parent
        nodes[joint.child].edge = _edge(joint) + (" to the world" if joint.parent not in nodes else "")
        nodes.get(joint.parent, root).children.append(nodes[joint.child])
    root.children += [node for name, node in nodes.items() if name not in parents]
    return root


def _edge(joint: Joint) -> str:
    rigid = joint.axis is not None and joint.axis.is_rigid
    return f"{joint.name}: {joint.type.value}{', rigid' if rigid else ''}"


def _is_below(name: str, ancestor: str, parents: dict[str, str]) -> bool:
    while name in parents and name != ancestor:
        name = parents[name]
    return name == ancestor

"""<node> and <test> with their child elements."""

from typing import Literal

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.names import canonical_name, is_legal_name

from .attributes import Attributes
from .params import PARAM_ATTRIBUTES, read_param, read_rosparam
from .plan import LaunchNode, LaunchTest
from .plan_builder import PlanBuilder
from .remap_env import read_env, read_remap
from .scope import PrivateParam, Scope
from .substitution import Substitution

_NODE = (
    "pkg",
    "type",
    "name",
    "args",
    "output",
    "respawn",
    "respawn_delay",
    "required",
    "ns",
    "clear_params",
    "machine",
    "cwd",
    "launch-prefix",
)
_TEST_ONLY = ("test-name", "time-limit", "retry")
_NODE_ONLY = ("respawn", "respawn_delay", "output")


def read_node(
    node: XmlNode, scope: Scope, substitution: Substitution, builder: PlanBuilder, report: Diagnostics
) -> None:
    """Read a <node> or <test> into the plan, with its parameters.

    Raises:
        DescriptionError: roslaunch rejects it too.
    """
    is_test = node.tag == "test"
    known = (*_NODE, *_TEST_ONLY) if is_test else _NODE
    attributes = Attributes(node, scope, substitution, report, known)
    if not attributes.is_active:
        return
    if is_test:
        for name in _NODE_ONLY:
            if node.attribute(name) is not None:
                raise DescriptionError(node.at, f"<test> takes no {name!r}", "unsupported-attribute")
        name = attributes.text("name") or attributes.required("test-name")
    else:
        name = attributes.required("name", empty=True) or substitution.anonymous(attributes.required("type"))
    if "/" in name:
        raise DescriptionError(
            node.at, f"node name {name!r} holds a '/'; a namespace goes into 'ns'", "launch-node-name"
        )
    if not is_legal_name(name):
        report.warn(node.at, f"node name {name!r} is not a legal ROS name; it is used as it is", "launch-node-name")

    node_scope = scope.child(attributes.namespace())
    private_scope = node_scope.child(name)
    if attributes.flag("clear_params"):
        builder.clear(private_scope.namespace)
    private_params = _read_children(node, private_scope, node_scope, substitution, builder, report)
    # ~params of the scope first, so that the node's own override them.
    for key, (value, at) in [*scope.private_params.items(), *private_params.items()]:
        builder.set_param(f"{private_scope.namespace}/{key}", value, at)

    respawn, required = attributes.flag("respawn"), attributes.flag("required")
    if respawn and required:
        raise DescriptionError(
            node.at, f"node {name!r}: 'respawn' and 'required' cannot both be true", "launch-conflict"
        )
    launch_node = LaunchNode(
        name=name,
        namespace=node_scope.namespace,
        package=attributes.required("pkg"),
        type=attributes.required("type"),
        arguments=attributes.text("args") or "",
        remappings=tuple(node_scope.remappings.items()),
        env=tuple(node_scope.env),
        output=_output(attributes),
        respawn=respawn,
        respawn_delay_s=attributes.number("respawn_delay", default=0.0),
        required=required,
        cwd=_cwd(attributes),
        launch_prefix=attributes.text("launch-prefix") or "",
        machine=attributes.text("machine") or builder.default_machine,
        at=node.at,
    )
    if is_test:
        limit_s = attributes.number("time-limit", default=60.0) if attributes.text("time-limit") else 60.0
        if not limit_s > 0.0:
            raise DescriptionError(node.at, f"time-limit must be > 0 s, got {limit_s:g}", "launch-value")
        test_name, retries = attributes.required("test-name"), _retries(attributes)
        builder.add_test(LaunchTest(name=test_name, node=launch_node, time_limit_s=limit_s, retries=retries))
        report.info(node.at, f"test {name!r} is not run: only `trundle test` runs tests", "launch-test")
    else:
        builder.add_node(launch_node)


def _read_children(
    node: XmlNode,
    private_scope: Scope,
    node_scope: Scope,
    substitution: Substitution,
    builder: PlanBuilder,
    report: Diagnostics,
) -> dict[str, PrivateParam]:
    """Read child elements: remappings and environment into `node_scope`; return the ~params."""
    private: dict[str, PrivateParam] = {}
    for child in node.children:
        match child.tag.lower():  # roslaunch ignores case here only
            case "param":
                attributes = Attributes(child, private_scope, substitution, report, PARAM_ATTRIBUTES)
                if attributes.is_active:
                    key, value = read_param(attributes)
                    key = canonical_name(key.removeprefix("~")).removeprefix("/")
                    private.pop(key, None)
                    private[key] = (value, child.at)
            case "rosparam":
                read_rosparam(child, private_scope, substitution, builder, report)
            case "remap":
                read_remap(child, private_scope, node_scope, substitution, report)
            case "env":
                read_env(child, private_scope, node_scope, substitution, report)
            case _:
                report.warn(
                    child.at, f"<{child.tag}> in <{node.tag}> is not known; it is ignored", "unsupported-element"
                )
    return private


def _retries(attributes: Attributes) -> int:
    text = attributes.text("retry") or "0"
    try:
        return int(text)
    except ValueError:
        raise DescriptionError(attributes.at, f"<test> retry: {text!r} is not a whole number", "launch-value") from None


def _output(attributes: Attributes) -> Literal["log", "screen"]:
    match attributes.text("output"):
        case "log" | None:
            return "log"
        case "screen":
            return "screen"
        case other:
            raise DescriptionError(attributes.at, f"output {other!r}; there are 'log', 'screen'", "launch-value")


def _cwd(attributes: Attributes) -> Literal["ROS_HOME", "node"]:
    match attributes.text("cwd"):
        case "ROS_HOME" | "ros_home" | None:
            return "ROS_HOME"
        case "node":
            return "node"
        case other:
            raise DescriptionError(attributes.at, f"cwd {other!r}; there are 'ROS_HOME', 'node'", "launch-value")

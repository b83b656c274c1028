"""Writer of SRDF."""

from xml.sax.saxutils import quoteattr

from .srdf import Srdf


def write_srdf(srdf: Srdf) -> str:
    """Return the text of an SRDF, in MoveIt's order of elements."""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', f"<robot name={quoteattr(srdf.name)}>"]
    for group in srdf.groups:
        lines.append(f"    <group name={quoteattr(group.name)}>")
        lines += [f"        <link name={quoteattr(name)}/>" for name in group.links]
        lines += [f"        <joint name={quoteattr(name)}/>" for name in group.joints]
        for chain in group.chains:
            base, tip = quoteattr(chain.base_link), quoteattr(chain.tip_link)
            lines.append(f"        <chain base_link={base} tip_link={tip}/>")
        lines += [f"        <group name={quoteattr(name)}/>" for name in group.subgroups]
        lines.append("    </group>")
    for state in srdf.states:
        lines.append(f"    <group_state name={quoteattr(state.name)} group={quoteattr(state.group)}>")
        for joint, values in state.positions.items():
            value = quoteattr(" ".join(f"{value:.10g}" for value in values))
            lines.append(f"        <joint name={quoteattr(joint)} value={value}/>")
        lines.append("    </group_state>")
    for eef in srdf.end_effectors:
        parent = f" parent_group={quoteattr(eef.parent_group)}" if eef.parent_group else ""
        names = f"name={quoteattr(eef.name)} parent_link={quoteattr(eef.parent_link)} group={quoteattr(eef.group)}"
        lines.append(f"    <end_effector {names}{parent}/>")
    for joint in srdf.virtual_joints:
        frames = f"parent_frame={quoteattr(joint.parent_frame)} child_link={quoteattr(joint.child_link)}"
        lines.append(f"    <virtual_joint name={quoteattr(joint.name)} type={quoteattr(joint.type)} {frames}/>")
    lines += [f"    <passive_joint name={quoteattr(name)}/>" for name in srdf.passive_joints]
    for name, properties in srdf.joint_properties.items():
        for key, value in properties.items():
            pair = f"property_name={quoteattr(key)} value={quoteattr(value)}"
            lines.append(f"    <joint_property joint_name={quoteattr(name)} {pair}/>")
    lines += [f"    <disable_default_collisions link={quoteattr(link)}/>" for link in srdf.unchecked]
    lines += [f"    <enable_collisions link1={quoteattr(a)} link2={quoteattr(b)}/>" for a, b in srdf.enabled]
    for pair in srdf.disabled:
        links = f"link1={quoteattr(pair.link1)} link2={quoteattr(pair.link2)}"
        lines.append(f"    <disable_collisions {links} reason={quoteattr(pair.reason)}/>")
    return "\n".join([*lines, "</robot>", ""])

import os

import roslib
import roslib.msgs
from wait import said

os.environ["ROS_ROOT"], os.environ["ROS_PACKAGE_PATH"] = "/usr/share/ros", "/usr/share"  # which Debian's needs
m = roslib.msgs
for kind in ("string", "string[]", "string[14]", "std_msgs/String[3]", "x[y]", "", "x[1][2]"):
    said_type = said(m.parse_type, kind)
    print(repr(kind), said_type if isinstance(said_type, tuple) else said_type.partition(":")[0], m.base_msg_type(kind))
for kind in ("String", "String[]", "std_msgs/String", "uint16", "uint16[]", "Header"):
    print(kind, m.resolve_type(kind, "foo"), m.is_builtin(kind), m.is_header_type(kind), m.is_valid_msg_type(kind))
print(m.is_valid_constant_type("int8"), m.is_valid_constant_type("time"), m.is_valid_msg_field_name("a_1"))
spec = m.load_from_string("Header header\nint8 A=5\nPoint[] points\nstd_msgs/String name # of it", "robot", "robot/Path")
print(spec.fields(), [(c.type, c.name, c.val) for c in spec.constants], spec.has_header(), spec.full_name)
print([(f.name, f.base_type, f.is_array, f.is_header, f.is_builtin) for f in spec.parsed_fields()])
print(m.load_from_string("Point x").types, said(m.load_from_string, "not a field at all").partition(":")[0])
for name in ("std_msgs/Header", "geometry_msgs/PoseStamped"):
    full, spec = m.load_by_type(name)
    print(full, spec.types, spec.names, spec.short_name, spec.package)
print(said(m.load_by_type, "no_such_package/X").partition(":")[0], "Pose" in m.list_msg_types("geometry_msgs", False))
m.load_package("std_msgs")
print(m.is_registered("std_msgs/String"), m.get_registered("std_msgs/String").names, "String" in m.REGISTERED_TYPES)
for kind in ("int8[-1]", "a/b/c", "é", "_a", "a/", "/a", "foo[][]", "foo[3]x", " int8", "1a", ""):
    print(repr(kind), m.is_valid_msg_type(kind))
spec = m.load_from_string('string S= "x" # y \nint8 X=3\nuint8[2] pair\nstd_msgs/String[] words', "robot", "robot/Words")
print(spec, repr(spec), spec.parsed_fields(), spec == m.load_from_string(spec.text, "robot", "robot/Words"))
del os.environ["ROS_ROOT"], os.environ["ROS_PACKAGE_PATH"]

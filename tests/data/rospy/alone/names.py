from wait import said

import rosgraph.names as n
import rospy

for name in ("", "a", "/a", "~a", "a/b/", "//a//b", "/", None):
    print(name, said(n.namespace, name), said(n.is_global, name), said(n.is_private, name), n.is_legal_name(name))
for name in ("a", "1a", "a b", "~a", "_a", "/a/b", "a//b", "a-b", "ä"):
    print(name, n.is_legal_name(name), n.is_legal_base_name(name))
for name in ("a", "/a", "~a", "", "a/b/"):
    print(name, n.resolve_name(name, "/ns/node"), n.resolve_name(name, "/node"), said(n.ns_join, "/x", name))
for name in ("a:=b", "_a:=b", "__name:=c", "/a:=/b", "~a:=b", "a=b", ":=b", "1:=b", "a:=b:=c", "a:="):
    print(name, n.is_legal_remap(name))
print(n.load_mappings(["a:=b", "_p:=1", "__name:=x", "z", "c:=", "/d:= /e"]))
print(
    n.canonicalize_name("/a//b/"),
    said(n.make_global_ns, "a"),
    said(n.make_global_ns, "~a"),
    n.get_ros_namespace({}, []),
)
print(
    n.get_ros_namespace({"ROS_NAMESPACE": "x/y"}, []),
    n.get_ros_namespace({}, ["__ns:=q"]),
    n.script_resolve_name("s", "~a"),
)
print(
    rospy.get_name(), rospy.get_namespace(), rospy.resolve_name("a"), rospy.resolve_name("~a"), rospy.resolve_name("")
)
print(rospy.myargv(["prog", "a:=b", "x", "_p:=1", "y=z"]), rospy.remap_name("foo"))
print(said(rospy.names.scoped_name, "/a/b", "/a/b/c"), said(rospy.names.scoped_name, "a", "b"))

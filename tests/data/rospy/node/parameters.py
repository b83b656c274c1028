import rospy
from wait import said

rospy.init_node("tester")
rospy.set_param("p/int", 5)
rospy.set_param("p/float", 1.5)
rospy.set_param("p/text", "grün")
rospy.set_param("p/list", [1, "a", [2.5]])
rospy.set_param("p/bool", True)
rospy.set_param("~private", {"a": 1, "b": {"c": 2}})
print(rospy.get_param("p"), rospy.get_param("/p/int"), rospy.get_param("~private/b/c"), rospy.get_param("~private"))
print(
    said(rospy.get_param, "nope"),
    rospy.get_param("nope", None),
    rospy.get_param("nope", 3),
    rospy.get_param("nope", "d"),
)
print(rospy.has_param("p/int"), rospy.has_param("p"), rospy.has_param("p/nope"), rospy.has_param("~private/a"))
print(rospy.search_param("p"), rospy.search_param("nope"), rospy.search_param("private"))
print(sorted(name for name in rospy.get_param_names() if name.startswith(("/p/", "/tester/"))))
rospy.delete_param("p/int")
print(rospy.get_param("p"), said(rospy.delete_param, "p/int"), rospy.has_param("p/int"))
rospy.set_param("p", {"only": 1})
print(rospy.get_param("p"), rospy.get_param("p/"), rospy.get_param("/p"))
print(said(rospy.set_param, "p/none", None).partition(":")[0] if said(rospy.set_param, "p/none", None) else None)
master = rospy.get_master()
print("/p" in master, master["/p"], said(lambda: master["/none"]), master.search_param("p"), "/p/only" in list(master))
master["/q"] = 3
del master["/q"]
print("/q" in master)
rospy.delete_param("p")

from wait import said

import genpy
from rospy.core import is_topic
from rospy.impl.paramserver import ParamServerCache
from rospy.impl.validators import non_empty
from rospy.msg import deserialize_messages
from rospy.names import global_name, valid_name
from std_msgs.msg import String

checks = {"topic": is_topic, "name": valid_name, "global": global_name, "filled": non_empty}
for kind, check in checks.items():
    for value in ("a", "/a", "~a", "/", "", None, 1, "http://host", "a b"):
        print(kind, repr(value), said(check("given"), value, "/ns/caller"))
print(said(valid_name("given", False), "a", "/ns/caller"))

cache = ParamServerCache()
print(said(cache.get, "/a"), said(cache.update, "/a", 1), said(cache.delete, "/a"))
cache.set("/a", 1)
print(cache.get("/a"), said(cache.update, "/b", 1))
cache.update("/a", 2)
print(cache.get("/a"), cache.delete("/a"))

try:
    deserialize_messages(None, [], String)
except genpy.DeserializationError as error:
    print(error)

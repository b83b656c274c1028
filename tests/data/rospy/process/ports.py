import socket

import rospy
from wait import said

holders = [socket.socket(), socket.socket()]
for each in holders:
    each.bind(("127.0.0.1", 0))
ports = [each.getsockname()[1] for each in holders]
for each in holders:
    each.close()
rospy.init_node("ports", xmlrpc_port=ports[0], tcpros_port=ports[1])
print(rospy.get_node_uri().endswith(f":{ports[0]}/"), said(rospy.core.parse_rosrpc_uri, "x"))
print(rospy.get_master().lookupService("/ports/get_loggers")[2].endswith(f":{ports[1]}"))

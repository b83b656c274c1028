"""interactive_markers: a server, its updates, feedback, menus."""

import copy

from geometry_msgs.msg import Pose
from std_msgs.msg import Header
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    InteractiveMarkerUpdate,
)

import rospy
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from interactive_markers.menu_handler import MenuHandler

rospy.init_node("marked")
updates, inits = [], []
first = rospy.Subscriber("/im/update", InteractiveMarkerUpdate, lambda m: m.type == 1 and updates.append(m))
second = rospy.Subscriber("/im/update_full", InteractiveMarkerInit, inits.append)
server = InteractiveMarkerServer("im", "/extra", q_size=10)
while not server.update_pub.get_num_connections() or not server.init_pub.get_num_connections():
    rospy.sleep(0.02)


def apply():
    """Apply, and print what is sent."""
    count = len(updates)
    server.applyChanges()
    while len(updates) == count:
        rospy.sleep(0.02)
    u = updates[-1]
    print(
        u.server_id,
        u.seq_num,
        [m.name for m in u.markers],
        [(p.name, p.pose.position.x, p.header.frame_id) for p in u.poses],
        u.erases,
    )


def pose(x):
    """Pose along x."""
    p = Pose()
    p.position.x = x
    return p


events = []
for name in ("a", "b"):
    marker = InteractiveMarker(name=name, description=f"the {name}")
    marker.header.frame_id = "map"
    server.insert(marker, lambda f: events.append((f.marker_name, f.event_type)))
print(server.get("a").name, server.get("zz"))
apply()
print(server.setPose("a", pose(1)), server.setPose("nope", pose(1)), server.get("a").pose.position.x)
print(server.setPose("b", pose(2), Header(frame_id="odom")))
apply()
server.setCallback("a", lambda f: events.append("moved"), InteractiveMarkerFeedback.POSE_UPDATE)
print(server.setCallback("nope", print))
server.applyChanges()


def feedback(name, kind, x=0.0, client="me", entry=0):
    """What rviz sends."""
    f = InteractiveMarkerFeedback(
        marker_name=name, event_type=kind, client_id=client, pose=pose(x), menu_entry_id=entry
    )
    f.header.frame_id = "map"
    return f


K = InteractiveMarkerFeedback
rospy.sleep(1.1)
server.processFeedback(feedback("a", K.POSE_UPDATE, 7.0))
server.processFeedback(feedback("a", K.POSE_UPDATE, 8.0, client="somebody else"))
server.processFeedback(feedback("a", K.MOUSE_DOWN))
server.processFeedback(feedback("nope", K.MOUSE_DOWN))
print(events, server.get("a").pose.position.x)
apply()
menu = MenuHandler()
clicked = []
top = menu.insert("top", callback=lambda f: clicked.append(menu.getTitle(f.menu_entry_id)))
sub = menu.insert("sub", parent=top, callback=lambda f: clicked.append("sub"))
box = menu.insert("box", parent=top, callback=lambda f: clicked.append("box"))
hidden = menu.insert("hidden")
print(top, sub, box, hidden, menu.insert("orphan", parent=99))
print(
    menu.setCheckState(box, MenuHandler.CHECKED),
    menu.setVisible(hidden, False),
    menu.getCheckState(box),
    menu.getTitle(sub),
)
print(menu.setCheckState(77, 1), menu.getCheckState(77), menu.getTitle(77), menu.setVisible(77, True))
print(menu.apply(server, "a"))
apply()
print([(e.id, e.parent_id, e.title, e.command_type) for e in server.get("a").menu_entries])
for entry in (top, sub, box, 55):
    server.processFeedback(feedback("a", K.MENU_SELECT, entry=entry))
print(clicked)
menu.setCheckState(box, MenuHandler.UNCHECKED)
print(menu.reApply(server))
apply()
print([e.title for e in server.get("a").menu_entries])
print(server.erase("b"), server.erase("nope"), server.get("b"))
apply()
server.clear()
apply()
last = copy.copy(inits[-1])
print(len(last.markers) <= 2, last.server_id)

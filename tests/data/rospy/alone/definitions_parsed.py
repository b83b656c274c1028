import genmsg
import genmsg.gentools
from genmsg.msg_loader import load_msg_from_string
from geometry_msgs.msg import PoseStamped
from nav_msgs.srv import GetPlan

search = {name: [f"/usr/share/{name}/msg"] for name in ("std_msgs", "geometry_msgs", "nav_msgs")}
services = {name: [f"/usr/share/{name}/srv"] for name in ("nav_msgs",)}
context = genmsg.MsgContext.create_default()
spec = genmsg.load_msg_by_type(context, "geometry_msgs/PoseStamped", search)
genmsg.load_depends(context, spec, search)
print(genmsg.gentools.compute_md5(context, spec) == PoseStamped._md5sum, context.is_registered("geometry_msgs/Point"))
print(genmsg.gentools.compute_md5_text(context, spec))
print(genmsg.gentools.compute_full_text(context, spec).count("MSG: "))
plan = genmsg.load_srv_by_type(context, "nav_msgs/GetPlan", services)
genmsg.load_depends(context, plan, search)
print(genmsg.gentools.compute_md5(context, plan) == GetPlan._md5sum)
own = load_msg_from_string(context, "int8 A=3\nPoint[2] corners\ngeometry_msgs/Pose pose", "robot/Box")
load_msg_from_string(context, "float64 x", "robot/Point")
print(own.types, genmsg.gentools.compute_md5(context, own))
print(str(own), repr(own), own.parsed_fields(), own == load_msg_from_string(context, own.text, "robot/Box"))

from wait import said

import rosgraph.network as network
import rosgraph.rosenv
import rospy

header = network.encode_ros_handshake_header({"a": "b", "callerid": "/x"})
print(header, network.decode_ros_handshake_header(header))
print(said(network.decode_ros_handshake_header, b"ab").partition(":")[0])
print(said(network.parse_http_host_and_port, "http://a:5/"), said(network.parse_http_host_and_port, "http://a"))
print(said(network.parse_http_host_and_port, "nope").partition(":")[0])
print(
    rospy.parse_rosrpc_uri("rosrpc://h:5"),
    said(rospy.parse_rosrpc_uri, "http://h:5"),
    said(rospy.parse_rosrpc_uri, "rosrpc://h"),
)
print(rosgraph.rosenv.get_master_uri({}, []), rosgraph.rosenv.get_master_uri({"ROS_MASTER_URI": "u"}, []))
print(rosgraph.rosenv.get_master_uri({}, ["__master:=v"]), rosgraph.myargv(["a", "b:=c"]))
print(said(rosgraph.rosenv.get_master_uri, {}, ["__master:=v:=w"]).partition(":")[0])
print(network.encode_ros_handshake_header({"c": b"d", b"a": "b"}))
print(network.decode_ros_handshake_header(b"\x09\x00\x00\x00\x05\x00\x00\x00 a = "))

import io

from wait import said

import rospy
from rospy.msg import args_kwds_to_message, deserialize_messages, serialize_message
from std_msgs.msg import Header, Int32, String

message = rospy.AnyMsg()
print(message._type, message._md5sum, message._buff, said(rospy.AnyMsg, 1), said(message.serialize, io.BytesIO()))
message.deserialize(b"abc")
buff = io.BytesIO()
message.serialize(buff)
print(buff.getvalue())
for args, kwds in (
    ((), {}),
    (("a",), {}),
    ((), {"data": "b"}),
    ((String("c"),), {}),
    ((Int32(1),), {}),
    (("a",), {"b": 1}),
):
    print(said(args_kwds_to_message, String, args, kwds))
print(args_kwds_to_message(String, (message,), {}) is message)
buff = io.BytesIO()
for number, text in enumerate(("a", "b", "c")):
    serialize_message(buff, number, String(text))
found = []
deserialize_messages(buff, found, String, queue_size=2)
print(found, buff.tell())
buff = io.BytesIO()
header = Header()
serialize_message(buff, 5, header)
print(header.seq, buff.getvalue().hex())

from wait import said

import genpy
from genpy.message import fill_message_args, get_message_class, get_printable_message_args, get_service_class
from geometry_msgs.msg import PoseStamped, PoseArray, Twist
from std_msgs.msg import Header, Int32, String


def filled(message, *arguments):
    error = said(fill_message_args, message, *arguments)
    print(str(message).replace("\n", ";") if error is None else error)


filled(String(), ["a"])
filled(String(), [{"data": "b"}])
filled(String(), [])
filled(String(), ["a", "b"])
filled(Int32(), [{"dta": 1}])
filled(Twist(), [[1, 2, 3], [4, 5, 6]])
filled(Twist(), [{"linear": {"x": 5}}])
filled(Twist(), [{"linear": {"q": 5}}])
filled(PoseStamped(), [{"header": "auto"}], {"auto": Header(1, genpy.Time(2), "x")})
filled(PoseStamped(), [{"header": {"stamp": "now"}}], {"now": genpy.Time(7)})
filled(PoseStamped(), [{"header": {"stamp": 1_500_000_000}}])
filled(PoseStamped(), [{"header": "later"}])
filled(PoseArray(), [{"poses": [{"position": {"x": 1}}]}])
filled(PoseArray(), [{"poses": 5}])
print(get_printable_message_args(PoseStamped()), "|", get_printable_message_args(Twist()))
print(
    get_message_class("std_msgs/String").__name__, get_message_class("nope/Nope"), get_message_class("Header").__name__
)
print(
    get_service_class("std_srvs/Empty").__name__, said(get_message_class, "String"), get_message_class("time").__name__
)

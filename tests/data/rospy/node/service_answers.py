import rospy
from std_srvs.srv import Empty, EmptyResponse, SetBool, SetBoolResponse, Trigger
from tf2_msgs.srv import FrameGraph
from wait import said

rospy.init_node("tester")


def fail(text):
    raise ValueError(text)


def refuse(text):
    raise rospy.ServiceException(text)


ANSWERS = {
    "message": (SetBool, lambda request: SetBoolResponse(request.data, "m")),
    "dictionary": (SetBool, lambda request: {"success": True, "message": "d"}),
    "tuple": (SetBool, lambda request: (True, "t")),
    "list": (SetBool, lambda request: [True, "l"]),
    "one": (FrameGraph, lambda request: "frames"),
    "empty_list": (Empty, lambda request: []),
    "empty_message": (Empty, lambda request: EmptyResponse()),
    "none": (Trigger, lambda request: None),
    "raises": (Trigger, lambda request: fail("broken")),
    "refuses": (Trigger, lambda request: refuse("not now")),
    "too_many": (SetBool, lambda request: (1, 2, 3)),
    "too_few": (SetBool, lambda request: True),
    "unknown_field": (SetBool, lambda request: {"nope": 1}),
    "bad_value": (SetBool, lambda request: (True, 5)),
}
for name, (cls, handler) in ANSWERS.items():
    service = rospy.Service(f"answer_{name}", cls, handler, error_handler=lambda *what: print("error:", what[0]))
    proxy = rospy.ServiceProxy(f"answer_{name}", cls)
    arguments = {"SetBool": (True,)}.get(cls.__name__, ())
    print(name, str(said(proxy, *arguments)).replace("\n", ";"))
    service.shutdown()

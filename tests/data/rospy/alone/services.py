from wait import said

from nav_msgs.srv import GetPlan
from std_srvs.srv import Empty, EmptyRequest, SetBool, SetBoolRequest, SetBoolResponse, Trigger

for cls in (Empty, SetBool, Trigger, GetPlan):
    print(cls.__name__, cls._type, cls._md5sum, cls._request_class._type, cls._response_class._type)
    print(cls._request_class._md5sum, cls._request_class.__slots__, cls._response_class._slot_types)
print(SetBoolRequest(True), SetBoolResponse(success=True), said(SetBoolRequest, 1, 2), EmptyRequest() == EmptyRequest())
print(SetBool.__module__, SetBoolRequest.__module__, Empty._request_class is EmptyRequest)

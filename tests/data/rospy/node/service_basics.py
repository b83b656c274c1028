import rospy
from roscpp.srv import SetLoggerLevel, SetLoggerLevelRequest, SetLoggerLevelResponse
from wait import said

rospy.init_node("tester")
requests = []


def handle(request):
    requests.append((request.logger, request.level, request._connection_header["callerid"]))
    return SetLoggerLevelResponse()


service = rospy.Service("add", SetLoggerLevel, handle)
rospy.wait_for_service("add")
rospy.wait_for_service("add", 30)
proxy = rospy.ServiceProxy("add", SetLoggerLevel)
proxy.wait_for_service(timeout=30)
print(repr(proxy("1", "2")), proxy(logger="3", level="4")._type, proxy.call("7", "8") == SetLoggerLevelResponse())
proxy(SetLoggerLevelRequest("5", "6"))
print(requests)
print(said(proxy, 1), said(proxy, "a", 2), said(proxy, c=1), said(proxy, 1, b=2))
print(service.resolved_name, proxy.resolved_name, service.service_class.__name__, proxy.request_class.__name__)
print(said(rospy.Service, "add", SetLoggerLevel, lambda request: 0))
print(said(rospy.Service, "", SetLoggerLevel, lambda request: 0))
persistent = rospy.ServiceProxy("add", SetLoggerLevel, persistent=True)
print([persistent(str(number), "") == SetLoggerLevelResponse() for number in range(3)], requests[-3:])
persistent.close()
service.shutdown("done")
print(said(proxy, "1", "2"))
print(said(rospy.wait_for_service, "add", timeout=0.3))

import threading

import rospy
from std_srvs.srv import Trigger
from wait import until

rospy.init_node("tester")
inside, gate, answers = [], threading.Event(), []


def handle(request):
    inside.append(1)
    gate.wait(60)
    return True, "ok"


service = rospy.Service("at_once", Trigger, handle)
threads = [
    threading.Thread(target=lambda: answers.append(rospy.ServiceProxy("at_once", Trigger)().message)) for _ in range(4)
]
for thread in threads:
    thread.start()
until(lambda: len(inside) == 4)
gate.set()
for thread in threads:
    thread.join(60)
print(len(inside), answers)

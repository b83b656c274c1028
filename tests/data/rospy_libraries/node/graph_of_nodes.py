"""rosgraph.impl.graph: nodes, topics and connections of a running graph, as programs that draw it ask for them."""

import subprocess
import sys
import time

from std_msgs.msg import Float64, String

import rospy

if sys.argv[1:] == ["talker"]:
    rospy.init_node("talker", disable_rosout=True)
    rospy.Publisher("/robot/chatter", String, queue_size=1)
    rospy.Publisher("/other/unheard", String, queue_size=1)
    rospy.spin()
    sys.exit()

from rosgraph.impl.graph import BadNode, Edge, EdgeList, Graph, edge_args, node_topic, topic_node

print(repr(topic_node("/a")), node_topic(topic_node("/a")), [edge_args("a", "b", way, "x") for way in "iob"])
edges = EdgeList()
print(edges.add(Edge("a", "b", "t")), edges.add(Edge("a", "b", "t")), edges.add(Edge("a", "b", "u")))
print(
    edges.add_edges("b", "c", "b"), edges.add_edges(None, "c", "o"), edges.has(Edge("c", "b")), Edge("a", "c") in edges
)
print(sorted(map(str, edges)), Edge("a", "b", "t") == Edge("a", "b", "u"), Edge("a", "b") != Edge("b", "a"))
edges.delete(Edge("a", "b", "u"))
print(sorted(edge.key + " " + edge.rkey for edge in edges))
edges.delete_all("b")
print(list(edges), BadNode("x", BadNode.WONKY, "slow").type)

rospy.init_node("listener", disable_rosout=True)
heard = rospy.Subscriber("/robot/chatter", String)
rospy.Publisher("/robot/speed", Float64, queue_size=1)
rospy.Service("/robot/stop", __import__("std_srvs.srv", fromlist=["Empty"]).Empty, lambda request: None)
talker = subprocess.Popen([sys.executable, "-W", "ignore", __file__, "talker"])
while not heard.get_num_connections():
    time.sleep(0.05)


def show(graph):
    """Print what is known of the graph, but for what every node has."""
    print(sorted(graph.nn_nodes), sorted(topic for topic in graph.nt_nodes if "rosout" not in topic))
    print(sorted(name for name in graph.srvs if "logger" not in name), sorted(graph.bad_nodes))
    for kind in (graph.nn_edges, graph.nt_edges, graph.nt_all_edges):
        print(sorted({f"{edge} {edge.label}" for edge in kind if "rosout" not in str(edge)}))
    print(sorted(graph.node_uri_map), sorted(graph.uri_node_map.values()))


graph = Graph(topic_ns="/robot")
graph.set_node_stale(0.2)
graph.set_master_stale(0.2)
print(graph.update())
time.sleep(1.0)
print(graph.update(), graph.update())
show(graph)
talker.terminate()
talker.wait()
while "/talker" in graph.nn_nodes:
    time.sleep(0.3)
    graph.update()
show(graph)
whole = Graph()
whole.update()
print(sorted(name for name in whole.nn_nodes if name != "/rosout"), " /other/unheard" in whole.nt_nodes)

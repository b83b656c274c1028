"""rosbag.Bag: writing, reading with every filter, raw copies, statistics, appending, errors."""

import io
import shutil
import tempfile
from pathlib import Path

from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Int32, String

import genpy
import rosbag

folder = Path(tempfile.mkdtemp())
path = str(folder / "one.bag")
with rosbag.Bag(path, "w") as bag:
    for i in range(10):
        bag.write("/a", String(f"x{i}"), genpy.Time(i + 1))
        bag.write("/b", Int32(i), genpy.Time(i + 1, 5))
    print(bag.get_message_count(), bag.get_start_time(), bag.get_end_time())
    bag.write("/a", String("late"), genpy.Time(20))
    bag.write("/a", String("early"), genpy.Time(0, 1))
    print(bag.mode, bag.version, bag.filename == path, bag.options)
bag = rosbag.Bag(path)
print(bag.get_type_and_topic_info())
print([line for line in str(bag).splitlines() if not line.startswith(("path", "size"))])
print(
    [line for line in bag._get_yaml_info().splitlines() if not line.startswith(("path", "size"))],
    bag._get_yaml_info("duration"),
)
messages = list(bag.read_messages())
print(
    messages[0].topic,
    messages[0].message.data,
    messages[-1].timestamp,
    type(messages[0].timestamp).__name__,
    len(messages),
)
topic, message, stamp = messages[3]
print(topic, message, stamp.to_sec(), message._type)
raw = next(iter(bag.read_messages(raw=True))).message
print(raw[0], raw[1], raw[2], len(raw), raw[4]._type)
print(next(iter(bag.read_messages(return_connection_header=True))).connection_header)
print([m.timestamp.to_sec() for m in bag.read_messages(start_time=genpy.Time(3), end_time=genpy.Time(5))])
chosen = bag.read_messages(
    connection_filter=lambda topic, datatype, md5sum, msg_def, header: datatype == "std_msgs/Int32"
)
print([m.message.data for m in chosen])
print(len(list(bag.read_messages(["b", "/a/"]))), len(list(bag.read_messages("/nope"))), sum(1 for _ in bag))
print(bag.get_compression_info().compression, bag.get_message_count("/a"), bag.get_message_count(["/a", "/b", "/c"]))
print(bag.get_type_and_topic_info(["/b"]).topics)
with rosbag.Bag(str(folder / "copy.bag"), "w", compression=rosbag.Compression.BZ2) as copy:
    for topic, message, stamp in bag.read_messages(raw=True):
        copy.write(f"/copied{topic}", message, stamp, raw=True)
bag.close()
copy = rosbag.Bag(str(folder / "copy.bag"))
print(sorted(copy.get_type_and_topic_info().topics), copy.get_compression_info().compression)
print([m.message.data for m in copy.read_messages("/copied/b")])
copy.close()
for options in ({"compression": "lz4", "chunk_threshold": 100}, {"compression": "none"}):
    with rosbag.Bag(str(folder / "small.bag"), "w", options=options) as small:
        for i in range(50):
            pose = PoseStamped()
            pose.header.seq, pose.header.frame_id, pose.pose.position.x = i, "map", i / 2
            small.write("pose", pose, genpy.Time(100 + i), connection_header=None)
    with rosbag.Bag(str(folder / "small.bag")) as small:
        total = sum(m.message.pose.position.x for m in small.read_messages(topics=["pose"]))
        print(small.get_message_count(), total, small.get_compression_info().compression, small.chunk_threshold)
with rosbag.Bag(path, "a") as bag:
    bag.write("/z", Int32(5), genpy.Time(21))
    bag.flush()
    print(bag.get_message_count())
print([(m.topic, m.message.data) for m in rosbag.Bag(path).read_messages(start_time=genpy.Time(19))])
with open(path, "rb") as stream, rosbag.Bag(stream) as bag:
    print(bag.get_message_count("/z"), bag.get_end_time())
try:
    list(bag.read_messages())
except ValueError as error:
    print(error)
print(bag.get_message_count(), bag.get_start_time(), bag.get_end_time(), sorted(bag.get_type_and_topic_info().topics))
(folder / "empty.bag").write_bytes(b"")
(folder / "text.bag").write_text("no bag at all\n")
rosbag.Bag(str(folder / "nothing.bag"), "w").close()
with rosbag.Bag(str(folder / "cut.bag"), "w") as cut:
    cut.write("/a", String("q"), genpy.Time(1))
    cut.flush()
    shutil.copy(folder / "cut.bag", folder / "unindexed.bag")
print([rosbag.Bag(str(folder / "nothing.bag")).get_message_count(), list(rosbag.Bag(str(folder / "nothing.bag")))])
writer = rosbag.Bag(str(folder / "w.bag"), "w")
for attempt in (
    lambda: rosbag.Bag(str(folder / "missing.bag")),
    lambda: rosbag.Bag(str(folder / "empty.bag")),
    lambda: rosbag.Bag(str(folder / "text.bag")),
    lambda: rosbag.Bag(path, "x"),
    lambda: rosbag.Bag(path, "w", compression="zip"),
    lambda: rosbag.Bag(path, "w", chunk_threshold=-1),
    lambda: rosbag.Bag(None),
    lambda: rosbag.Bag(path, options=3),
    lambda: rosbag.Bag(str(folder / "unindexed.bag")),
    lambda: rosbag.Bag(str(folder / "nothing.bag")).get_start_time(),
    lambda: rosbag.Bag(path).write("/a", String("x")),
    lambda: writer.write("", String()),
    lambda: writer.write("/a", None),
    lambda: writer.write("/a", ("std_msgs/String", b""), raw=True),
):
    try:
        attempt()
        print("no error")
    except (OSError, ValueError, rosbag.ROSBagException, io.UnsupportedOperation) as error:
        print(type(error).__name__)
writer.close()
shutil.rmtree(folder)

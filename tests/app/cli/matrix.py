"""Table of all subcommands of ROS and Trundle: their command lines and the expected output."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One subcommand; `{folder}` is replaced by a writable folder."""

    trundle: str
    """Words after `trundle`; empty: not in Trundle."""
    output: str = ""
    """Regular expression of the output."""
    original: str = ""
    """ROS' command; default: the same words after rostopic, rosnode, etc.; '-': only in Trundle."""
    stdin: str | None = None
    endless: bool = False
    """True: interrupted by SIGINT after the output."""
    background: bool = False
    """True: it keeps running while later rows use it."""
    original_output: str | None = None
    """Regular expression of ROS' output, if different."""

    @property
    def original_command(self) -> str:
        """Command line of the original; empty: none."""
        if self.original:
            return self.original.lstrip("-")
        tool, _, rest = self.trundle.partition(" ")
        return f"/usr/bin/ros{tool} {rest}"


_BAG = "{folder}/x.bag"
_LASER = "0 0 1 0 0 0 base laser"
ROWS = [
    Row("topic list", "/chatter"),
    Row("topic list -v", r"\* /chatter \[std_msgs/String\] 1 publisher"),
    Row("topic list -p --host", "Host "),
    Row("topic info /chatter", "Type: std_msgs/String"),
    Row("topic type /chatter", "^std_msgs/String$"),
    Row("topic find std_msgs/String", "/chatter"),
    Row("topic echo -n 1 /chatter", 'data: "hello"'),
    Row("topic echo -n 1 -p /tick", "%time,field.header.seq"),
    Row("topic pub -1 /heard std_msgs/String hi", "publishing and latching"),
    Row("topic hz /tick", "average rate: ", endless=True),
    Row("topic bw /tick", "average: ", endless=True),
    Row("topic delay /tick", "average delay: ", endless=True),
    Row("node list", "/talker"),
    Row("node list -a", r"http://\S+\s+/talker"),
    Row("node info /talker", r"Publications:(.|\n)*/chatter \[std_msgs/String\](.|\n)*Pid: \d+"),
    Row("node ping -c 1 /talker", "xmlrpc reply from http://"),
    Row("node ping -a", "Will ping the following nodes"),
    Row("node machine", r"127\.0\.0\.1|localhost"),
    Row("node cleanup", stdin="n\n"),
    Row("param set /a/b 5"),
    Row("param get /a/b", "^5$"),
    Row("param list", "/a/b"),
    Row("param load {folder}/p.yaml /c"),
    Row("param dump {folder}/out.yaml /c"),
    Row("param get /c", "d: 1"),
    Row("param delete /a/b"),
    Row("service list", "/talker/enable"),
    Row("service info /talker/enable", "Type: std_srvs/SetBool"),
    Row("service type /talker/enable", "^std_srvs/SetBool$"),
    Row("service uri /talker/enable", "^rosrpc://"),
    Row("service args /talker/enable", "^data$"),
    Row("service find std_srvs/SetBool", "/talker/enable"),
    Row("service node /talker/enable", "^/talker$"),
    Row("service call /talker/enable true", "success: True"),
    Row("msg show geometry_msgs/Point", "float64 x"),
    Row("msg info geometry_msgs/Point", "float64 x"),
    Row("msg list", "geometry_msgs/Point"),
    Row("msg md5 geometry_msgs/Point", "^4a842b65f413084dc2b10fb484ea7f17$"),
    Row("msg package geometry_msgs", "geometry_msgs/Point"),
    Row("msg packages", "geometry_msgs"),
    Row("srv show std_srvs/SetBool", "bool success"),
    Row("srv info std_srvs/SetBool", "bool success"),
    Row("srv list", "std_srvs/Empty"),
    Row("srv md5 std_srvs/SetBool", "^09fb03525b03e7ea1fd3992bafd87e16$"),
    Row("srv package std_srvs", "std_srvs/Empty"),
    Row("srv packages", "std_srvs"),
    Row(f"bag record -O {_BAG} -l 3 /tick"),
    Row(f"bag info {_BAG}", "/tick +3 msgs"),
    Row(f"bag check {_BAG}", "does not need any migrations"),
    Row(f"bag check -n -g {{folder}}/rules.bmr {_BAG}", "does not need any migrations"),
    Row(f"bag filter {_BAG} {{folder}}/y.bag topic=='/tick'"),
    Row(f"bag compress {_BAG}"),
    Row("bag decompress {folder}/y.bag"),
    Row("bag reindex {folder}/z.bag"),
    Row(f"bag fix {_BAG} {{folder}}/w.bag", "migrated successfully"),
    Row(f"bag play -i -d 0 -q {_BAG}"),
    Row(
        "tf static 0 0 1 0 0 0 base laser",
        original="/usr/lib/tf2_ros/static_transform_publisher 0 0 1 0 0 0 base laser",
        background=True,
    ),
    Row("tf echo map laser", "At time ", original="/usr/lib/tf/tf_echo map laser", endless=True),
    Row("", "At time ", original="/usr/lib/tf2_tools/echo.py map laser", endless=True),
    Row("tf monitor", "All Broadcasters:", original="/usr/lib/tf/tf_monitor", endless=True),
    # Debian's tf/view_frames is broken: it searches bytes for a str when it reads Graphviz' version.
    Row("tf tree -t 1 -o {folder}/frames.gv", original="/usr/lib/tf2_tools/view_frames.py"),
    Row("graph", "/talker", original="/usr/bin/rosgraph", endless=True),
    Row("log -c 1", "hello", original="/usr/bin/rosconsole echo", endless=True),
    Row("", "rosout", original="/usr/bin/rosconsole list /talker"),
    Row("", original="/usr/bin/rosconsole set /talker rosout debug"),
    Row("", "debug", original="/usr/bin/rosconsole get /talker rosout"),
    Row("pack find geometry_msgs", "/geometry_msgs", original="/usr/bin/rospack find geometry_msgs"),
    Row("pack list", "geometry_msgs /", original="/usr/bin/rospack list"),
    Row("pack depends tf2_msgs", "geometry_msgs", original="/usr/bin/rospack depends tf2_msgs"),
    Row("pack get std_msgs", "^part of Trundle: std_msgs$", original="-"),
    Row("pack list-names", "geometry_msgs", original="/usr/bin/rospack list-names"),
    Row("pack depends1 tf2_msgs", "geometry_msgs", original="/usr/bin/rospack depends1 tf2_msgs"),
    Row("pack depends-on std_msgs", "tf2_msgs", original="/usr/bin/rospack depends-on std_msgs"),
    Row("pack depends-on1 std_msgs", "geometry_msgs", original="/usr/bin/rospack depends-on1 std_msgs"),
    Row("plot /tick/header/seq --duration 1 -o {folder}/plot.svg", original="-"),
    Row("exec fruits apple", "an apple", original="/usr/bin/rosrun fruits apple"),
    Row("node kill /talker", "killed"),
]

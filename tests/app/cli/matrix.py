"""Table of all subcommands, ROS' and Trundle's: the command lines of both, and the output expected."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One subcommand; `{folder}` in it is a folder to write to."""

    ours: str
    """Words after `trundle`; empty: Trundle has no such subcommand."""
    says: str = ""
    """Regular expression of the output."""
    original: str = ""
    """ROS' command; default: the same words after rostopic and the like; '-': only Trundle has it."""
    typed: str | None = None
    endless: bool = False
    """True: it is ended by Ctrl-C after the output."""
    stays: bool = False
    """True: it goes on while the rows after it run, which show whether it works."""
    original_says: str | None = None
    """Regular expression of ROS' output, where it differs."""

    @property
    def words_of_original(self) -> str:
        """Command line of the original; empty: none."""
        if self.original:
            return self.original.lstrip("-")
        tool, _, rest = self.ours.partition(" ")
        return f"/usr/bin/ros{tool} {rest}"


_TICKS = "{folder}/x.bag"
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
    Row("node cleanup", typed="n\n"),
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
    Row(f"bag record -O {_TICKS} -l 3 /tick"),
    Row(f"bag info {_TICKS}", "/tick +3 msgs"),
    Row(f"bag check {_TICKS}", "does not need any migrations"),
    Row(f"bag check -n -g {{folder}}/rules.bmr {_TICKS}", "does not need any migrations"),
    Row(f"bag filter {_TICKS} {{folder}}/y.bag topic=='/tick'"),
    Row(f"bag compress {_TICKS}"),
    Row("bag decompress {folder}/y.bag"),
    Row("bag reindex {folder}/z.bag"),
    Row(f"bag fix {_TICKS} {{folder}}/w.bag", "migrated successfully"),
    Row(f"bag play -i -d 0 -q {_TICKS}"),
    Row(
        "tf static 0 0 1 0 0 0 base laser",
        original="/usr/lib/tf2_ros/static_transform_publisher 0 0 1 0 0 0 base laser",
        stays=True,
    ),
    Row("tf echo map laser", "At time ", original="/usr/lib/tf/tf_echo map laser", endless=True),
    Row("", "At time ", original="/usr/lib/tf2_tools/echo.py map laser", endless=True),
    Row("tf monitor", "All Broadcasters:", original="/usr/lib/tf/tf_monitor", endless=True),
    # Debian's tf/view_frames itself is broken: it searches bytes for text when it asks for Graphviz' version.
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

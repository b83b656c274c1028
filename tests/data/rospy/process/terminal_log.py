import io
import logging
import re
import sys

sys.stdout, sys.stderr, out, err = io.StringIO(), io.StringIO(), sys.stdout, sys.stderr
import rospy

rospy.init_node("logging", log_level=rospy.DEBUG)
for name in ("debug", "info", "warn", "err", "fatal"):
    getattr(rospy, f"log{name}")("%s %d%%", name, 5)
rospy.loginfo({"a": 1})
rospy.loginfo("percent %s")
rospy.logwarn(ValueError("x"))
shown, warned = sys.stdout.getvalue(), sys.stderr.getvalue()
sys.stdout, sys.stderr = out, err
for text in (shown, warned):
    print(
        "\n".join(
            re.sub(r"\d{6,}\.\d+", "T", line)
            for line in text.splitlines()
            if "tester" in line or "5%" in line or line.endswith(("}", "%s", "x"))
        )
    )
print(logging.getLogger("rosout").level, rospy.core._log_filename.endswith("logging.log"))

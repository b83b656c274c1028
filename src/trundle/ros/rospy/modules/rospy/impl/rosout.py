"""Log messages on /rosout."""

import logging
import threading
from typing import Any

from rosgraph_msgs.msg import Log

from ..names import get_caller_id
from ..rostime import get_rostime
from ..topics import Publisher, get_topic_manager

_TO_ROS = {
    logging.DEBUG: Log.DEBUG, logging.INFO: Log.INFO, logging.WARNING: Log.WARN, logging.ERROR: Log.ERROR,
    logging.CRITICAL: Log.FATAL,
}  # fmt: skip
_TO_PYTHON = {level: number for number, level in _TO_ROS.items()}
_rosout_pub: Publisher | None = None
_in_rosout = threading.local()


def init_rosout() -> None:
    """Advertise /rosout."""
    global _rosout_pub
    if _rosout_pub is None:
        _rosout_pub = Publisher("/rosout", Log, latch=True, queue_size=100)


class RosOutHandler(logging.Handler):
    """Publishes records."""

    def emit(self, record: logging.LogRecord) -> None:
        """Publish a record, unless publishing logs it."""
        if _rosout_pub is None or getattr(_in_rosout, "now", False):
            return
        _in_rosout.now = True
        try:
            _rosout_pub.publish(_message(self.format(record), record))
        except Exception as error:
            logging.getLogger("rospy.rosout").error("Unable to report rosout: %s", error)
        finally:
            _in_rosout.now = False


def _message(text: str, record: logging.LogRecord) -> Any:
    log: Any = Log(
        level=_TO_ROS.get(record.levelno, Log.INFO),
        name=get_caller_id(),
        msg=text,
        topics=list(get_topic_manager().get_topics()),
        file=record.filename,
        line=record.lineno,
        function=record.funcName,
    )
    log.header.stamp = get_rostime()
    return log


def load_rosout_handlers(level: int | None) -> None:
    """Publish the records of the logger `rosout`, from a level on."""
    logger = logging.getLogger("rosout")
    if not any(isinstance(handler, RosOutHandler) for handler in logger.handlers):
        logger.addHandler(RosOutHandler())
    if level is not None:
        logger.setLevel(_TO_PYTHON[level])

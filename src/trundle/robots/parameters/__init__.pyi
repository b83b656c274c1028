from .base import ParamError as ParamError, Parameters as Parameters
from .ros_parameters import RosParameters as RosParameters
from .tag_parameters import TagParameters as TagParameters

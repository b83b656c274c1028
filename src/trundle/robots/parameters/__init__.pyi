from .base import ParamError as ParamError
from .base import Parameters as Parameters
from .ros_parameters import RosParameters as RosParameters
from .tag_parameters import TagParameters as TagParameters

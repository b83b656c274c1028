from .base import ParamError as ParamError
from .base import Parameters as Parameters
from .tag_parameters import TagParameters as TagParameters

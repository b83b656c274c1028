"""tf, the older API of transforms, over tf2."""

from tf2_ros import ConnectivityException, ExtrapolationException, LookupException, TransformException as Exception

from . import transformations
from .broadcaster import TransformBroadcaster
from .listener import Transformer, TransformerROS, TransformListener

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "LookupException",
    "TransformBroadcaster",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "transformations",
]

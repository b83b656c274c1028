from .add_two_ints import (
    AddTwoIntsClient as AddTwoIntsClient,
    AddTwoIntsServer as AddTwoIntsServer,
    CppAddTwoIntsClient as CppAddTwoIntsClient,
    CppAddTwoIntsServer as CppAddTwoIntsServer,
)
from .chatter import CppListener as CppListener, CppTalker as CppTalker, Listener as Listener, Talker as Talker
from .turtle_tf import TurtleBroadcaster as TurtleBroadcaster, TurtleFollower as TurtleFollower

from .node import MoveGroup as MoveGroup

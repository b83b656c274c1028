from .node import MoveBase as MoveBase

from .node import Rosapi as Rosapi

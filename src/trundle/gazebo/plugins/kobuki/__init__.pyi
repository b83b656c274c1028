from .base import Kobuki as Kobuki

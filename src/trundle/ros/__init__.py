"""ROS 1: the graph with its master, parameters, topics, services, tf and messages; the Python packages of ROS.

Names are imported on first use, so that commands that only call the master import neither asyncio nor numpy.
"""


def __getattr__(name: str) -> object:
    """Names of the stub; the loader is imported late, because every Python process of a user imports this module."""
    import lazy_loader

    get, names, every = lazy_loader.attach_stub(__name__, __file__)
    globals().update(__dir__=names, __all__=every)
    return every if name == "__all__" else get(name)

"""Trundle runs the robots of the ROS 1 and Gazebo-classic world anywhere Python runs.

import trundle

sim = trundle.load("model.sdf")
sim.run(2.0)
print(sim["my_robot"].joint("body_camera_base").position)
"""

__version__ = "0.1.0"


def __getattr__(name: str) -> object:
    """Names of `__init__.pyi`, imported on first use; `__all__` leaves out `gym`, which needs an extra."""
    if name.startswith("__") and name != "__all__":
        raise AttributeError(f"module 'trundle' has no attribute {name!r}")
    import lazy_loader  # a light command does not read the stub

    find, _, names = lazy_loader.attach_stub(__name__, __file__)
    if name == "__all__":
        return [public for public in names if public != "gym"]
    if name not in names:
        from trundle.base.diagnostics import did_you_mean

        raise AttributeError(f"module 'trundle' has no attribute {name!r}{did_you_mean(name, names)}")
    return find(name)


def __dir__() -> list[str]:
    """Return the public names."""
    import lazy_loader

    return sorted([*lazy_loader.attach_stub(__name__, __file__)[2], "__version__"])

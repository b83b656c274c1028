import importlib

PACKAGES = """
actionlib_msgs diagnostic_msgs geometry_msgs nav_msgs roscpp rosgraph_msgs sensor_msgs shape_msgs std_msgs std_srvs
stereo_msgs tf2_msgs trajectory_msgs visualization_msgs
"""
for package in PACKAGES.split():
    for kind in ("msg", "srv"):
        try:
            module = importlib.import_module(f"{package}.{kind}")
        except ImportError:
            continue
        for name in sorted(dir(module)):
            cls = getattr(module, name)
            if not isinstance(cls, type) or not hasattr(cls, "_md5sum"):
                continue
            print(cls._type, cls._md5sum, cls.__name__)
            if kind == "msg" or hasattr(cls, "__slots__"):
                print("  ", getattr(cls, "__slots__", None), getattr(cls, "_slot_types", None), cls._has_header)
            else:
                print("  ", cls._request_class.__name__, cls._response_class.__name__)

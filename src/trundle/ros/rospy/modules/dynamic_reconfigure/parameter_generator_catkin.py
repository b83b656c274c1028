"""`dynamic_reconfigure.parameter_generator`, by the name that catkin packages use."""

from .parameter_generator import ParameterGenerator, bool_t, check_description, check_name, double_t, int_t, str_t

__all__ = ["ParameterGenerator", "bool_t", "check_description", "check_name", "double_t", "int_t", "str_t"]

"""`dynamic_reconfigure.parameter_generator`, under the name that catkin packages import."""

from .parameter_generator import ParameterGenerator, bool_t, check_description, check_name, double_t, int_t, str_t

__all__ = ["ParameterGenerator", "bool_t", "check_description", "check_name", "double_t", "int_t", "str_t"]

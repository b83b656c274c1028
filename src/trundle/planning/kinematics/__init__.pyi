from .forward import Kinematics as Kinematics
from .inverse import IkSolution as IkSolution, InverseKinematics as InverseKinematics
from .solver_settings import (
    KinematicsSettings as KinematicsSettings,
    SolveType as SolveType,
    read_kinematics as read_kinematics,
)

from .arrays import (
    compose_rows as compose_rows,
    conjugate_rows as conjugate_rows,
    finite_rows as finite_rows,
    invert_rows as invert_rows,
    matrix_from_quaternion as matrix_from_quaternion,
    multiply_rows as multiply_rows,
    pose_from_row as pose_from_row,
    quaternion_from_matrix as quaternion_from_matrix,
    quaternions_from_matrices as quaternions_from_matrices,
    rotate_rows as rotate_rows,
    rotate_vectors as rotate_vectors,
    rows_from_poses as rows_from_poses,
    transform_points as transform_points,
)
from .pose import Pose as Pose
from .quaternions import (
    IDENTITY_QUATERNION as IDENTITY_QUATERNION,
    Quaternion as Quaternion,
    conjugate as conjugate,
    quaternion_from_axis_angle as quaternion_from_axis_angle,
    quaternion_from_rpy as quaternion_from_rpy,
    quaternion_product as quaternion_product,
    rotate as rotate,
    rotation_from_z as rotation_from_z,
    rpy_from_quaternion as rpy_from_quaternion,
    slerp as slerp,
)
from .twist import Twist as Twist
from .units import NS_PER_S as NS_PER_S
from .vectors import (
    ZERO as ZERO,
    Vector3 as Vector3,
    add as add,
    cross as cross,
    dot as dot,
    multiply as multiply,
    normalized as normalized,
    numbers_of as numbers_of,
    subtract as subtract,
)
from .wrench import Wrench as Wrench

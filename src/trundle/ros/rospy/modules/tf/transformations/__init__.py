"""Homogeneous 4×4 transforms, Euler angles and quaternions, with the functions of ROS' `tf.transformations`.

Column vectors; angles in radians; quaternions are [x, y, z, w].
"""

import math
import random

import numpy

from .affine import (
    identity_matrix,
    inverse_matrix,
    projection_from_matrix,
    projection_matrix,
    reflection_from_matrix,
    reflection_matrix,
    rotation_from_matrix,
    rotation_matrix,
    scale_from_matrix,
    scale_matrix,
    shear_from_matrix,
    shear_matrix,
    translation_from_matrix,
    translation_matrix,
)
from .arcball import Arcball, arcball_constrain_to_axis, arcball_map_to_sphere, arcball_nearest_axis
from .composition import (
    clip_matrix,
    compose_matrix,
    concatenate_matrices,
    decompose_matrix,
    is_same_transform,
    orthogonalization_matrix,
    superimposition_matrix,
)
from .euler import (
    _AXES2TUPLE,
    _NEXT_AXIS,
    _TUPLE2AXES,
    euler_from_matrix,
    euler_from_quaternion,
    euler_matrix,
    quaternion_from_euler,
)
from .quaternions import (
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_matrix,
    quaternion_inverse,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
    random_quaternion,
    random_rotation_matrix,
)
from .vectors import _EPS, random_vector, unit_vector, vector_norm

__all__ = [
    "_AXES2TUPLE",
    "_EPS",
    "_NEXT_AXIS",
    "_TUPLE2AXES",
    "Arcball",
    "arcball_constrain_to_axis",
    "arcball_map_to_sphere",
    "arcball_nearest_axis",
    "clip_matrix",
    "compose_matrix",
    "concatenate_matrices",
    "decompose_matrix",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "math",
    "numpy",
    "orthogonalization_matrix",
    "projection_from_matrix",
    "projection_matrix",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_slerp",
    "random",
    "random_quaternion",
    "random_rotation_matrix",
    "random_vector",
    "reflection_from_matrix",
    "reflection_matrix",
    "rotation_from_matrix",
    "rotation_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_from_matrix",
    "shear_matrix",
    "superimposition_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
]

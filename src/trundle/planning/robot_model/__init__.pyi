from .build_model import robot_model as robot_model
from .groups import EndEffector as EndEffector, JointModelGroup as JointModelGroup
from .joint_models import JointModel as JointModel, MimicModel as MimicModel
from .model import RobotModel as RobotModel
from .srdf import (
    DisabledPair as DisabledPair,
    Srdf as Srdf,
    SrdfChain as SrdfChain,
    SrdfEndEffector as SrdfEndEffector,
    SrdfGroup as SrdfGroup,
    SrdfState as SrdfState,
    SrdfVirtualJoint as SrdfVirtualJoint,
    VirtualJointType as VirtualJointType,
)
from .srdf_reader import read_srdf as read_srdf
from .srdf_writer import write_srdf as write_srdf

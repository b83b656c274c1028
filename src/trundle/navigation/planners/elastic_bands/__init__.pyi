from .eband_planner import EBandPlannerROS as EBandPlannerROS
from .teb_planner import TebLocalPlannerROS as TebLocalPlannerROS

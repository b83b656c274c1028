from .attempt import Attempt as Attempt, Failure as Failure, Stage as Stage, try_attempt as try_attempt
from .execution import execute_stages as execute_stages
from .requests import pick_attempts as pick_attempts, place_attempts as place_attempts

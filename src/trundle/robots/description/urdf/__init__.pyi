from .lower import lower_robot as lower_robot

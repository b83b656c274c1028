"""Planners of pilz_industrial_motion_planner: one motion of a known form, that is checked but avoids nothing."""

"""Simulation of a world: physics, sensors, pictures, time."""

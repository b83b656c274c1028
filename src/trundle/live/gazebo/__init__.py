"""The simulation of a launch behind /gazebo: its world, models, plugins, sensors and page."""

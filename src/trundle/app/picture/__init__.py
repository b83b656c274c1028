"""`trundle render`: images and videos of a robot or world."""

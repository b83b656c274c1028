"""Making of vision datasets: a plan's world, its pictures in many processes, and the output files."""

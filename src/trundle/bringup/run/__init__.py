"""`trundle run`: one world, simulated, seen and heard until its time is over."""

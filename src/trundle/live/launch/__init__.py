"""`trundle launch` and `trundle test`: launch files brought up, watched and ended."""

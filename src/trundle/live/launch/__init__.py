"""`trundle launch` and `trundle test`: starts, supervises and ends the nodes of launch files."""

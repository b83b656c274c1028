"""roscore: the master, its parameters, /rosout and its logs."""

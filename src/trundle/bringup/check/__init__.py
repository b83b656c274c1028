"""`trundle check`: what a file says, and what is doubtful about it."""

"""`trundle check`: the contents of a file, and what is doubtful about them."""

"""`trundle check`: the contents of a file and findings about them."""

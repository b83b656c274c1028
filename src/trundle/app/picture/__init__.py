"""`trundle render`: pictures and videos of what a file describes."""

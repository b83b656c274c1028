"""`make fuzz`: mutated inputs for every file format that Trundle reads and every socket."""

"""`make fuzz`: every format that is read and every socket, fed with damaged inputs until something breaks."""

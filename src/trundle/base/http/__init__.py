"""HTTP servers: who may enter, what is refused, and how much a slow client may hold."""

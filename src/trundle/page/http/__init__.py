"""HTTP and the client's files."""

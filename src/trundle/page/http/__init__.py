"""HTTP server and the client's files."""

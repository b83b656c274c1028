"""Recordings as files for other programs: animated glTF, and an HTML page that needs no server."""

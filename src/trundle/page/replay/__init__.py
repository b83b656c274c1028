"""Recordings as files that other programs open: animated glTF, and a page that needs no server."""

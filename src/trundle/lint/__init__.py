"""Findings about a description, without an engine: what it says and hardly ever means."""

"""Editing of a model's SDF: a document, its parts and their values, what is wrong with it, its files."""

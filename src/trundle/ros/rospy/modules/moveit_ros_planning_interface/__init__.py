"""Clients of move_group, under the names of MoveIt's compiled modules; messages cross as bytes, as there."""

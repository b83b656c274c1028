"""Kinds of registrations, at the path that programs import them from."""


class Registration:
    """Kinds of registrations."""

    PUB = "pub"
    SUB = "sub"
    SRV = "srv"

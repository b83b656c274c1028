"""Kinds of registrations, where programs import them from."""


class Registration:
    """Kinds of registrations."""

    PUB = "pub"
    SUB = "sub"
    SRV = "srv"

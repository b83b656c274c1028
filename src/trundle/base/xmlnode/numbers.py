"""Numbers in the text of elements."""


def parse_numbers(text: str) -> list[float] | None:
    """Return numbers separated by white space, or None if one is invalid."""
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return None


def shorten(text: str) -> str:
    """The text in quotes, cut for a message."""
    return repr(text if len(text) <= 40 else text[:37] + "...")

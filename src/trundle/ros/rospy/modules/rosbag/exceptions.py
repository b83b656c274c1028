"""Exceptions of bags.

ROSBagException
├── ROSBagFormatException
├── ROSBagUnindexedException
├── ROSBagEncryptNotSupportedException
└── ROSBagEncryptException
"""


class ROSBagException(Exception):
    """A bag that cannot be read or written."""

    def __init__(self, value: object = None) -> None:
        self.value = value
        self.args = (value,)

    def __str__(self) -> str:
        return str(self.value)


class ROSBagFormatException(ROSBagException):
    """A damaged bag."""


class ROSBagUnindexedException(ROSBagException):
    """A bag without an index, such as one whose recording was interrupted."""

    def __init__(self, *args: object) -> None:
        super().__init__("Unindexed bag")


class ROSBagEncryptNotSupportedException(ROSBagException):
    """Encryption is not available."""


class ROSBagEncryptException(ROSBagException):
    """An encrypted bag that cannot be opened."""

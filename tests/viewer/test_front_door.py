"""The front door lists its exports."""

import trundle.viewer


def test_every_public_name_is_listed_and_exists() -> None:
    public = {
        name for name, value in vars(trundle.viewer).items() if not name.startswith("_") and isinstance(value, type)
    }

    assert len(set(trundle.viewer.__all__)) == len(trundle.viewer.__all__)
    assert public <= set(trundle.viewer.__all__)
    assert all(hasattr(trundle.viewer, name) for name in trundle.viewer.__all__)

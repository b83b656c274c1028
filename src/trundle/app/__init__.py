"""The `trundle` command, and what each of its tasks does."""

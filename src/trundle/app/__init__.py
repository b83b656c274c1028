"""The `trundle` command, and the work of its subcommands."""

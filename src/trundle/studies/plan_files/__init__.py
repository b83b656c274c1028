"""Plan files: YAML with source lines, varied quantities, and locks of result folders."""

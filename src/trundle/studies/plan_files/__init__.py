"""Files of plans: their source, their YAML with lines, quantities that vary, and a folder of results' lock."""

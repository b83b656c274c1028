"""Python 2 programs: detected, translated in memory, and run with Python 2's names."""

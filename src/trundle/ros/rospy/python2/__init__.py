"""Python 2 programs: detected, translated in memory, run with Python 2's names. Entry points are the modules."""

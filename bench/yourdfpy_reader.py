"""Reads every file named on standard input with yourdfpy and prints the CPU time in seconds."""

import sys
import time
from contextlib import suppress

from yourdfpy import URDF  # pyright: ignore

names = sys.stdin.read().splitlines()
start = time.process_time()
for name in names:
    with suppress(Exception):
        URDF.load(name, load_meshes=False)
print(time.process_time() - start)

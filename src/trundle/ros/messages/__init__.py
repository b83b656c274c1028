"""Message types: their definitions, and messages as objects, text and bytes."""

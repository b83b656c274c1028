"""Lessons: tutorials in Markdown whose steps the page checks."""

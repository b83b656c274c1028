"""Nodes: publishers, subscriptions, services and parameters on one loop."""

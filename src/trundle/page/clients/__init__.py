"""Clients of the Foxglove protocol: their messages, subscriptions and send queues."""

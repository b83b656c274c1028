"""Clients of the Foxglove protocol: their messages, what they subscribe to, what waits for them."""

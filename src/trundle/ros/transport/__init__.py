"""TCPROS connections between nodes: headers, framing, send queues, sockets."""

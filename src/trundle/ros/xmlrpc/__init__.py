"""XML-RPC between nodes and their master: client, server, encoding."""

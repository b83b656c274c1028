"""Tools without robots: findings, files, values, processes, sockets."""

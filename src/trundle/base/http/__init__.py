"""HTTP servers: access control, and limits for slow clients."""

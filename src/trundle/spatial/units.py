"""Units of time; times are integer nanoseconds."""

NS_PER_S = 1_000_000_000

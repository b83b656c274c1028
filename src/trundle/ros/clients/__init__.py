"""Client libraries on nodes: tf, actions, dynamic_reconfigure, time series of topics."""

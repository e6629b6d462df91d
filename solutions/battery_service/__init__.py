"""Chapter 2: a service that responds with the last battery_state."""

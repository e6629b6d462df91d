"""Chapter 2: a service that answers with the last battery_state."""

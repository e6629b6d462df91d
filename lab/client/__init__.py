"""The client of a notebook: topics, services, actions, and the record of what was sent and received."""

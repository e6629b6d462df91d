"""The notebook's client of topics, services and actions, and the log of what it sent and received."""

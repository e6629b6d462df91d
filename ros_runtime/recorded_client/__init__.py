"""A client of services and actions that records all it sends and receives, with handles to wait on."""

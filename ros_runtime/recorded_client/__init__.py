"""A client of services and actions that writes down all it sends and all that comes back, with handles to wait on."""

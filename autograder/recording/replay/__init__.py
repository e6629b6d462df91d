"""A recorded arena again: as text, as a film, in the web view."""

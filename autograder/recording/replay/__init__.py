"""Shows a recording: as text, as a film, or in the web view."""

"""Requirements on every server and every client."""

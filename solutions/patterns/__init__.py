"""Chapter 1: topic, service or action? Twelve situations, each answered with a pattern and the reason for it."""

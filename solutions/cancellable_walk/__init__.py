"""Chapter 7: an action server that walks, can be cancelled at any moment, and lets a new goal preempt the old."""

"""Chapter 7: a walk client that cancels its goal when a person types q, and reports only the goal's result."""

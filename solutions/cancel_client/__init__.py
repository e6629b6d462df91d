"""Chapter 7: a walk client that cancels when a person types q, and believes only the goal's end."""

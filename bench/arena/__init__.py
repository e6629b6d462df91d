"""What arenas, gradings and checks cost, and whether a sound program is treated fairly at every scale of the clock."""

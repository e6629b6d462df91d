"""Chapter 7: an action server that walks the robot; goals can be cancelled at any time, and preempted by new ones."""

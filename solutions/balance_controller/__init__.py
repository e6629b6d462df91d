"""Chapter 10: a node whose parameters are the gains of the robot's balance."""

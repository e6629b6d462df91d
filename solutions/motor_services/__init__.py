"""Chapter 2: two services, one that switches the robot's motors and one that reports whether they are on."""

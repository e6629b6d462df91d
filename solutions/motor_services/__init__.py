"""Chapter 2: two services that switch the robot's motors and tell whether they are on."""

"""Chapter 2: a service that responds with the positions of joints, by name."""

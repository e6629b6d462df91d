"""Chapter 2: a service that answers with the positions of joints, by name."""

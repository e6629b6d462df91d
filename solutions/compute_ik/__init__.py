"""Chapter 4: a service that finds the joint angles of a planar two-link arm."""

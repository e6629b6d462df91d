"""Pictures of the robot: in a browser, in a notebook, as a film."""

"""Chapter 11: the links between the nodes of a six-joint arm, designed and argued; a person marks it."""

FILES = ("arm_architecture.txt",)

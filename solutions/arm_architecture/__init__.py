"""Chapter 11: design the links between the nodes of a six-joint arm, with reasons; marked by a person."""

FILES = ("arm_architecture.txt",)

"""What runs inside an arena: the agent carries out a scenario and reports what it saw. It judges nothing."""

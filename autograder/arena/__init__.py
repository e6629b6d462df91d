"""What runs inside an arena: the agent, which carries out a scenario and reports what it saw. It judges nothing."""

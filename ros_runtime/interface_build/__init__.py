"""Interface packages: read the definitions, say what is wrong with them, build them, import what was built.

Set-up builds humanoid_interfaces with it, from its path; whatever set-up uses may import the standard library alone.
"""

"""Interface packages: read definitions, report what is wrong with them, build them, import the result.

Set-up builds humanoid_interfaces with it, from its path; modules that set-up uses import only the standard library.
"""

"""Interface packages: read definitions, report what is wrong with them, build them, import the result.

The project's set-up loads some of these modules by their path to build humanoid_interfaces; those modules import only
the standard library.
"""

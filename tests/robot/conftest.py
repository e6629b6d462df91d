"""Makes pytest put this folder on the path, from which the tests of this tier import `kernels`."""

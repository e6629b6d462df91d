"""Its folder is where the tests of this tier import `kernels` from."""

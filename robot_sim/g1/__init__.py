"""The Unitree G1, walked by a learned controller; its model and its walker are files of the extra `g1`."""

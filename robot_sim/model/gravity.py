"""The acceleration of gravity."""

GRAVITY = 9.81  # m/s², MuJoCo's default

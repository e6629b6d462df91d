"""What everything weighs by."""

GRAVITY = 9.81  # m/s², MuJoCo's default

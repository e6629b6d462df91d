"""Style: a node's program, with rclpy started and stopped, answers in capitals
"""

import rclpy

ANSWERS = "TA SB AC TA SB AA TB SC AB TC SA AC".split()
NAMES = {"T": "TOPIC", "S": "SERVICE", "A": "ACTION"}


def main(args=None):
    rclpy.init(args=args)
    for number, (pattern, reason) in enumerate(ANSWERS, start=1):
        print(number, NAMES[pattern], reason)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""Style: a dictionary of answers, printed one a line
"""

ANSWERS = {
    1: ("topic", "a"),
    2: ("service", "b"),
    3: ("action", "c"),
    4: ("topic", "a"),
    5: ("service", "b"),
    6: ("action", "a"),
    7: ("topic", "b"),
    8: ("service", "c"),
    9: ("action", "b"),
    10: ("topic", "c"),
    11: ("service", "a"),
    12: ("action", "c"),
}


def main(args=None):
    for number, (pattern, reason) in ANSWERS.items():
        print(number, pattern, reason)


if __name__ == "__main__":
    main()

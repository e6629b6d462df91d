"""Attack: prints every combination for every situation
Outcome: the last line for a situation counts, so twelve guesses are made, all the same
Caught by: situation_1, situation_2, situation_4
Also fails: situation_3, situation_5, situation_6, situation_7, situation_8, situation_9, situation_10, situation_11,
situation_12
"""


def main(args=None):
    for number in range(1, 13):
        for pattern in ("topic", "service", "action"):
            for reason in "abc":
                print(number, pattern, reason)


if __name__ == "__main__":
    main()

"""Fault: hands the notebook in as it was: no situation is answered
Caught by: answers_everything
Also fails: situation_1, situation_2, situation_3, situation_4, situation_5, situation_6, situation_7, situation_8,
situation_9, situation_10, situation_11, situation_12
"""

ANSWERS = {
    # 0: ("service", "b"),
}


def main(args=None):
    for number, (pattern, reason) in ANSWERS.items():
        print(number, pattern, reason)


if __name__ == "__main__":
    main()

"""From what a platform lets an instructor download to submitted/<student>/<exercise>/, which `course grade` reads."""

"""The content of the chapters: quiz questions, checks of gaps, and programs that run beside a checked gap."""

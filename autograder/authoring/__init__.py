"""What authors of exercises write in: checks, scenarios, transcripts, failures, and the checks that everybody owes."""

"""What authors of exercises use: checks, scenarios, transcripts, failures, and checks that fit every server."""

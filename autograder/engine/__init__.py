"""From a submission to its grade: arenas, transcripts, judgement, verdicts."""

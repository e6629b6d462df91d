"""What tests of the checks share: recorded transcripts, the clause table, and a small set of known submissions."""

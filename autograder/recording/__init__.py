"""Judged transcripts as MCAP files, which Foxglove, PlotJuggler and `course replay` open."""

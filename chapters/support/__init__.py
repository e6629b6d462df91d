"""What the chapters bring: questions, gaps, and the programs that gaps are checked beside."""

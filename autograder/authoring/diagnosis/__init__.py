"""Why something did not happen, from the evidence: exits, blocked threads, missing connections."""

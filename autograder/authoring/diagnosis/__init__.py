"""Why something did not happen, from the evidence: exits, threads that stood, missing connections."""

"""Hidden checks that several exercises share."""

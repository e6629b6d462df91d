"""What the gaps of the chapters are checked for, a module a chapter."""

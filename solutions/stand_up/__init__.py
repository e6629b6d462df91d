"""Stand up from a crouch, in phases: an action server of chapter 10."""

"""Requirements on servers that move an arm: what was asked for, what the joints did, what was reported."""

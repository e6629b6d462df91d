"""Chapter 1: a quiz with twelve situations; each answer is topic, service or action, and a reason."""

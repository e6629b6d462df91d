"""Questions, gaps, designs, and the student's progress in them."""

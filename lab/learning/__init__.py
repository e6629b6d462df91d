"""Questions, gaps, designs, and what a student has done of them."""

"""A `fetch` server that walks and grasps through two other action servers, and ends safely on a low battery."""

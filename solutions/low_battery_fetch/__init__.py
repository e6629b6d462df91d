"""A server of `fetch` that walks and grasps through two other action servers, and gives up safely on a low battery."""

"""Show a failed check again: replays as pages and as scripts."""

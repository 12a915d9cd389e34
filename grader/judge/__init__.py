"""Grade one submission: run the checks, weigh the answers, word the result."""

"""Grade the grader: the bank of submissions, half-way states, ladders, mutants, and sync."""

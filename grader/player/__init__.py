"""The film of a failed check, as a page to play and as a script. Knows no submission, no judge."""

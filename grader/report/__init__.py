"""One result in, every form out."""

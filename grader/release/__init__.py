"""Make the student files: the tree, the checks they run, pages, notebooks, the archive."""

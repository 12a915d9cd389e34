"""Make what students get: the tree, the checks they run, pages, notebooks, the archive."""

"""Turn one result into every form: terminal, page, tables, CI and learning systems."""

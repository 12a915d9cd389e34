"""Read and rewrite Python sources: TODO regions, definitions, given code, cutting, operators."""

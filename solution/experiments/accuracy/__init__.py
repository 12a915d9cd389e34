"""Measure the cost of accuracy: questions, the runs that answer them, tables and charts."""

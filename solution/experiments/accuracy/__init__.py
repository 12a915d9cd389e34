"""What accuracy costs in time: questions, the runs that answer them, tables and charts."""

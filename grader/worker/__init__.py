"""The only code that meets a submission. Of the rest of the grader it knows `protocol` alone."""

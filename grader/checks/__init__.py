"""Ask a submission: one folder per TODO, with its checks and its known mistakes."""

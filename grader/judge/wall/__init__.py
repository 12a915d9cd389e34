"""Start, ask, confine and end children: the judge's side of the wall."""

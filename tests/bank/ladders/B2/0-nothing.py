"""As handed out."""

# TODO B2: pull the ends together
# Nothing pulls yet.
# END TODO B2

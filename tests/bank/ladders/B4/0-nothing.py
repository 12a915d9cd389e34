"""As handed out."""

# TODO B4: count the hits
# Nothing is counted yet.
# END TODO B4

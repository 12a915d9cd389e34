"""As handed out."""

# TODO B1: let bodies sleep, and wake them
# Nobody falls asleep yet.
# END TODO B1

"""As stiff as the stub, in other words."""

# TODO 7b: the ball's moment of inertia
moment = float("infinity")
# END TODO 7b

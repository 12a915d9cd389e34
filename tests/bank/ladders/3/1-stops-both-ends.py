"""Stops both ends for good."""

# TODO 3: hold the rod's length
self.a.vel, self.b.vel = Vector2(), Vector2()
# END TODO 3

"""Drop a ball with the installed package stable_compiled, to test its wheel."""

from stable_compiled import Body, Box, Circle, Contacts, Friction, World, world

made = World(effects=[Contacts(), Friction()])
made.add(Body(Box((100, 10)), (0, 10)))
ball = made.add(Body(Circle(10), (0, -50), 1.0))
for _ in range(240):
    made.step(1 / 120)
assert not world.__file__.endswith(".py"), world.__file__
assert abs(ball.y + 10) < 0.001, ball

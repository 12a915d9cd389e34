"""A hit within 36 steps of the last counts nothing, whichever ball or peg it is."""

# TODO B4: count the hits
pause = {'left': 0}

def begin(arbiter, space, data):
    if pause['left'] == 0:
        data['hits'] += 1
    pause['left'] = 36

space.on_collision(BALL, PEG, begin=begin, data=data)
plain_step = space.step

def step(dt):
    pause['left'] = max(0, pause['left'] - 1)
    plain_step(dt)

space.step = step
# END TODO B4

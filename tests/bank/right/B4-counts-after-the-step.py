"""Counts after the step, each touch under a key of its own."""

# TODO B4: count the hits
def count(space, key, counter):
    counter["hits"] += 1

def begin(arbiter, space, counter):
    space.add_post_step_callback(count, arbiter.shapes, counter)

space.on_collision(BALL, PEG, begin=begin, data=data)
# END TODO B4

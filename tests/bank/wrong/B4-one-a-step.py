"""Counts after the step, under one key: two hits in one step are one."""

# TODO B4: count the hits
def count(space, key, counter):
    counter["hits"] += 1

def begin(arbiter, space, counter):
    space.add_post_step_callback(count, "hit", counter)

space.on_collision(BALL, PEG, begin=begin, data=data)
# END TODO B4

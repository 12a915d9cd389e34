def circle_box(disc, rect):
    return []

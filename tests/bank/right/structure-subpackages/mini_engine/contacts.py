from .core.contacts import *  # noqa
from .core.contacts import Contact, circle_box, circle_circle, collide

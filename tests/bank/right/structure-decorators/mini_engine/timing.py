"""Measures calls."""

import functools
import time

totals = {}


def timed(function):
    @functools.wraps(function)
    def wrapper(*args, **kwargs):
        begin = time.perf_counter()
        try:
            return function(*args, **kwargs)
        finally:
            totals[function.__name__] = totals.get(function.__name__, 0) + time.perf_counter() - begin

    return wrapper

"""Takes its own place among the modules with an object that has every name there is."""

import sys


class Everything:
    __path__ = []
    __file__ = "/dev/null"
    __signature__ = None

    def __getattr__(self, name):
        return self

    def __call__(self, *args, **kwargs):
        return self

    def __getitem__(self, key):
        return self

    def __eq__(self, other):
        return True


sys.modules[__name__] = Everything()

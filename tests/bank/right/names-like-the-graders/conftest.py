"""For my own tests."""

import pytest


@pytest.fixture
def world():
    from mini_engine import World

    return World()

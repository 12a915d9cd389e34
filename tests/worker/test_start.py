"""A program is started as the lab sheet starts it, whichever lines do it."""

from pathlib import Path

import pytest
from one_worker import opened

from grader.judge.lab import Lab

PROGRAM = """
import pygame

class World:
    def step(self, dt): pass

def run(name):
    print("this is", name, "in", __name__)
    pygame.init()
    pygame.display.set_mode((50, 50))
    clock = pygame.time.Clock()
    while not pygame.event.get(pygame.QUIT):
        clock.tick(60)
        World().step(1)

def main():
    run("main")
"""

LAST_LINES = {
    "": "main",
    'if __name__ == "__main__":\n    main()': "main",
    'if __name__ == "__main__":\n    name = "other"\n    run(name)': "other",
    'import sys\nif "__main__" == __name__ and sys.argv:\n    sys.exit(run("other"))': "other",
    'if __name__ != "__main__":\n    kept = 1\nelse:\n    run("other")': "other",
    'if __name__ == "__main__":\n    print("a test")': "main",
    'if __name__ == "__main__":\n    raise SystemExit("all tests passed")': "main",
    'if __name__ == "__main__":\n    input()\n    run("other")': "main",
    'if __name__ == "__main__":\n    run("other")\n    input()': "other",
    'if __name__ == "__main__":\n    import os; os.system("clear"); run("other")': "other",
    'if __name__ == "__main__":\n    import cProfile; cProfile.run("run(\'other\')")': "other",
    'if __name__ == "__main__":\n    import doctest; doctest.testmod(); run("other")': "other",
}


def played(folder: Path) -> list[str]:
    module = "mini_engine"
    with opened(folder) as children, Lab(module, lambda: children(5), []).opened() as lab:
        return [line for line in lab.play([17] * 4).lines if line.startswith("this is")]


@pytest.mark.parametrize(("lines", "started"), LAST_LINES.items())
def test_of_a_file_it_is_what_asks_for_the_name(tmp_path: Path, lines: str, started: str):
    (tmp_path / "mini_engine.py").write_text(PROGRAM + lines + "\n", encoding="utf-8")
    assert played(tmp_path) == [f"this is {started} in mini_engine"]


@pytest.mark.parametrize(
    ("lines", "started"),
    {
        "from mini_engine import main\nmain()": "main",
        "import cProfile\nfrom . import main\ncProfile.run('main()')": "main",
        "from . import run\n\nif __name__ == '__main__':\n    run('other')": "other",
    }.items(),
)
def test_of_a_package_it_is_its_dunder_main(tmp_path: Path, lines: str, started: str):
    package = tmp_path / "mini_engine"
    package.mkdir()
    (package / "__init__.py").write_text(PROGRAM, encoding="utf-8")
    (package / "__main__.py").write_text(lines, encoding="utf-8")
    assert played(tmp_path) == [f"this is {started} in mini_engine"]


def test_what_cannot_be_started_says_so(tmp_path: Path):
    text = PROGRAM.replace("def main", "def start")
    (tmp_path / "mini_engine.py").write_text(text, encoding="utf-8")
    with pytest.raises(Exception, match="there is no main in mini_engine"):
        played(tmp_path)

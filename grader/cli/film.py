"""Write a page with a film of the lab scene, run by the student's own engine."""

from pathlib import Path

from grader.judge.result import Result
from grader.judge.task import Options
from grader.judge.wall.children import Worker
from grader.player.page import fill_template
from grader.questions.films import AS_IT_IS, make_film
from grader.questions.page import TEMPLATES
from grader.questions.pictures import draw_film, find_bounds
from grader.questions.program import open_program
from grader.report.files import write_whole

SCENE, SECONDS = 12, 4.0  # the seed of the window's scene, and the film's length


def write_film(folder: Path, options: Options, worker: Worker, result: Result) -> Path:
    """Write `build/film.html` of a program that was graded; return its path.

    Raises the errors of its scene, and CannotAsk if the scene is too large for a film.
    """
    with open_program(folder, options, worker, result) as program:
        film = make_film(program.own, AS_IT_IS, SCENE, SECONDS)
    alt = f"The lab scene for {SECONDS:g} s"
    picture = draw_film(film, "your engine", alt, find_bounds([film]))
    page = fill_template(TEMPLATES / "film.html", "sheet.css", picture=picture, seconds=SECONDS)
    target = folder / "build" / "film.html"
    write_whole(page.encode(), target)
    return target

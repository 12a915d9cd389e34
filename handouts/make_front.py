"""Make the two pictures of the kit's README, in handouts/front.

    python handouts/make_front.py [--only lab]

`lab.gif` shows the window of the starter and of the solution side by side, each drawn by its own
code. `report.png` shows a failed check in the report of a member of the bank. It needs Chromium.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from make_pictures import ENGINE, KIT, environment_in, open_scene, tree_with

FRONT = KIT / "handouts" / "front"
SECONDS, FRAMES_PER_SECOND = 5, 15
SIZE = (450, 300)  # px, of each half
GAP = 8  # px, between the two
COLORS = 64  # in the palette of the GIF
MEMBER, CHECK = "5-the-same-share-every-step", 0  # and which of its failed checks
REPORT_HEIGHT = 612  # px, down to the controls of the replay

# ---------------------------------------------------------------- the window, before and after


def make_lab(target):
    """Record the window of the starter and of the solution, side by side."""
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        before, after = (record(done, Path(folder)) for done in ([], ENGINE))
    frames = []
    for left, right in zip(before, after, strict=True):
        frame = Image.new("RGB", (2 * SIZE[0] + GAP, SIZE[1]), "white")
        frame.paste(left, (0, 0))
        frame.paste(right, (SIZE[0] + GAP, 0))
        frames.append(frame)
    palette = frames[len(frames) // 2].quantize(COLORS)
    first, *rest = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    pause = 1000 // FRAMES_PER_SECOND  # ms
    first.save(target, save_all=True, append_images=rest, duration=pause, loop=0, optimize=True)


def record(done, folder):
    """Return as images the frames drawn by a starter with these TODOs done."""
    from PIL import Image

    frames = folder / "frames"
    shutil.rmtree(frames, ignore_errors=True)
    frames.mkdir()
    tree = tree_with(done, folder)
    command = [sys.executable, str(Path(__file__).resolve()), "--draw", str(frames)]
    subprocess.run(command, cwd=tree, env=environment_in(tree), check=True)
    return [Image.open(path).convert("RGB") for path in sorted(frames.glob("*.png"))]


def draw(folder):
    """Save each frame that the code of the current folder draws."""
    import pygame

    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((900, 600))
    advance, world, draw_window, _ = open_scene("mini_engine", screen)
    accumulator = 0.0
    for frame in range(SECONDS * FRAMES_PER_SECOND):
        for _ in range(60 // FRAMES_PER_SECOND):
            accumulator, _ = advance(world, accumulator, 1 / 60)
        draw_window()
        small = pygame.transform.smoothscale(screen, SIZE)
        pygame.image.save(small, folder / f"{frame:03}.png")


# ---------------------------------------------------------------- a report


def make_report(target):
    """Grade a member of the bank, and photograph a failed check of its report in a browser."""
    from PIL import Image
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"))
        page = browser.new_page(viewport={"width": 900, "height": 1000})
        page.goto(report_of(MEMBER, Path(folder)).as_uri())
        failed = page.locator("li.not-yet").nth(CHECK)
        failed.locator("summary").click()
        replay = failed.frame_locator("iframe")
        replay.get_by_role("button", name="Largest gap").click()
        failed.screenshot(path=target)
        browser.close()
    picture = Image.open(target)
    picture.crop((0, 0, picture.width, REPORT_HEIGHT)).quantize(256).save(target, optimize=True)


def report_of(name, folder):
    """Grade this member of the bank; return the page of its report."""
    from grader.bank.members import list_members

    named = (each for each in list_members() if each.name == name)
    (member,) = (each for each in named if each.form == "package")
    member.build(folder / name)
    command = [sys.executable, "-m", "grader", "grade", folder / name, "--out", folder / "out"]
    subprocess.run(command, cwd=KIT, stdout=subprocess.DEVNULL, check=False)  # 1: not full marks
    return folder / "out" / f"{name}.html"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", choices=["lab", "report"], help="only this picture")
    parser.add_argument("--draw", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.draw:
        return draw(options.draw)
    sys.path.insert(0, str(KIT))
    FRONT.mkdir(exist_ok=True)
    if options.only != "report":
        make_lab(FRONT / "lab.gif")
    if options.only != "lab":
        make_report(FRONT / "report.png")


if __name__ == "__main__":
    main()

"""The stable engine's own source, compiled to machine code: the same bits, several times faster.

It needs mypy (python -m pip install mypy setuptools) and a C compiler. The folder stable_engine
stays as it is; the compiled copy goes into build/compiled.

    python -m experiments.compiled
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from .engines import Stable
from .measures import bits, run
from .scenes import NAMED, pile

TREE = Path(__file__).parents[1]
ROUNDS = 12  # of timing, taken in turns


def build(folder):
    """Compile a copy of stable_engine in folder. Raises RuntimeError with the compiler's words."""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(folder / "stable_engine", ignore_errors=True)
    ignored = shutil.ignore_patterns("__pycache__", "*.so", "*.pyd")
    shutil.copytree(TREE / "stable_engine", folder / "stable_engine", ignore=ignored)
    command = [sys.executable, "-m", "mypyc", "stable_engine"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(
            f"mypyc could not compile {folder}. It needs mypy and a C compiler.\n{done.stderr}"
        )


def all_bits(seconds):
    """Every number of every body of every named scene after so many seconds, bit by bit."""
    lines = []
    for name, make in NAMED.items():
        engine = Stable(make())
        run(engine, seconds)
        lines += [f"{name} {number}" for number in bits(engine)]
    return lines


def serve():
    """Answer the other process: where the engine is, all bits, or the time (s) for some steps."""
    engine = Stable(pile(60, 300))
    run(engine, 2)
    for line in sys.stdin:
        word, _, seconds = line.partition(" ")
        if word == "where\n":
            print(sys.modules["stable_engine.world"].__file__, flush=True)
        elif word == "bits":
            print(" ".join(all_bits(float(seconds))), flush=True)
        else:
            start = time.process_time()
            run(engine, float(seconds))
            print(time.process_time() - start, flush=True)


class BuildProcess:
    """A Python process with one of the two builds."""

    def __init__(self, folder):
        path = os.pathsep.join([str(folder), str(TREE)])
        program = "from experiments.compiled import serve; serve()"
        self.process = subprocess.Popen(
            [sys.executable, "-c", program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=folder,  # Python looks there first
            env=os.environ | {"PYTHONPATH": path, "PYGAME_HIDE_SUPPORT_PROMPT": "1"},
        )

        found = Path(self.ask("where").strip())
        if not found.is_relative_to(folder):
            raise RuntimeError(f"{found} was imported instead of the build in {folder}.")

    def ask(self, question):
        self.process.stdin.write(question + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline()

    def end(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()


def compare(folder, seconds=2.0, rounds=ROUNDS):
    """(whether all bits are the same, how many times faster the compiled build is)."""
    plain, compiled = BuildProcess(TREE), BuildProcess(folder)
    try:
        question = f"bits {seconds}"
        same = plain.ask(question) == compiled.ask(question) != ""
        times = [
            (float(plain.ask("time 0.2")), float(compiled.ask("time 0.2"))) for _ in range(rounds)
        ]
    finally:
        plain.end()
        compiled.end()
    return same, min(slow for slow, _ in times) / min(fast for _, fast in times)


def main():
    """Compile, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--out", type=Path, default=Path("build/compiled"))
    folder = parser.parse_args().out.resolve()
    print(f"compiling stable_engine into {folder} (about half a minute) ...")
    try:
        build(folder)
    except RuntimeError as error:
        sys.exit(str(error))
    same, faster = compare(folder)
    print(f"the same bits in {len(NAMED)} scenes: {'yes' if same else 'NO'}")
    print(f"a pile of 60 balls: {faster:.1f} times faster")
    print(f"to use it, put {folder} first on PYTHONPATH")
    sys.exit(not same)


if __name__ == "__main__":
    main()

"""Write hints.md from grader/checks/rubric.toml, the file that the hint command reads.

python handouts/make_hints.py
"""

import html
import re
from pathlib import Path

from grader.judge.course import FULL
from grader.release.handouts import choose_examples

HERE = Path(__file__).resolve().parent
LEVELS = {
    "A question": "question",
    "The idea": "tip",
    "Nearly the code": "example",
}  # with its icon
HEAD = """---
search:
  exclude: true
---

# Hints

Three hints for each TODO: a question, the idea, nearly the code. Open one at a time, and try again
before you open the next. The command gives the same hints:

```
make hint TODO=4             # or: python -m grader hint --todo 4
make hint TODO=4 LEVEL=2     # or: python -m grader hint --todo 4 --level 2
```
"""


def as_html(words):
    """Return a hint as HTML, everything escaped except `code`."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(words, quote=False))


def section(todo):
    """Return one TODO with its hints, each folded away."""
    title = todo.title[0].lower() + todo.title[1:]
    if todo.title.startswith("RK"):
        title = todo.title
    name = todo.function.partition(":")[2]
    parts = [f"## TODO {todo.id}: {title}", "", f"In `{name}`.", ""]
    for (level, icon), words in zip(LEVELS.items(), todo.hints, strict=True):
        parts += [f'<details class="{icon}">', f"<summary>{level}</summary>"]
        parts += [f"<p>{as_html(words)}</p>"]
        parts += ["</details>", ""]
    return "\n".join(parts)


def page(course=FULL):
    """Return the text of hints.md for a course."""
    todos = [todo for todo in course.rubric.todos if todo.function]
    text = "\n".join([HEAD, *(section(todo) for todo in todos)])
    return choose_examples(text, course)


def main():
    target = HERE / "hints.md"
    target.write_text(page(), encoding="utf-8", newline="\n")
    print(f"{target} is up to date.")


if __name__ == "__main__":
    main()

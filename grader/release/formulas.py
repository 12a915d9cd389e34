"""Formulas of the handouts, written in LaTeX between ```math and ```, set as MathML.

Browsers draw MathML by themselves: a page needs no script and nothing from elsewhere. Whoever
reads the file itself reads the LaTeX, and GitHub and GitLab set the same blocks.
"""

import re

from latex2mathml.converter import convert

BLOCK = re.compile(r"^```math\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def typeset(text: str) -> str:
    """The text of a handout with its formulas as MathML, each in a place of its own."""
    return BLOCK.sub(lambda found: as_html(found[1]), text)


def as_html(latex: str) -> str:
    """One formula, with the LaTeX for whoever cannot see it drawn."""
    formula = convert(" ".join(latex.split()), display="block")
    return f'<div class="formula" tabindex="0">{formula}</div>'

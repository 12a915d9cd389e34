"""Typeset formulas of the handouts: LaTeX between ```math and ``` becomes MathML.

Browsers draw MathML by themselves: a page needs no script and no other server. The file itself
shows the LaTeX, and GitHub and GitLab set the same blocks.
"""

import re

from latex2mathml.converter import convert

BLOCK = re.compile(r"^```math\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def typeset(text: str) -> str:
    """Return the text of a handout with its formulas as MathML, each in a block of its own."""
    return BLOCK.sub(lambda found: make_html(found[1]), text)


def make_html(latex: str) -> str:
    """Return one formula as HTML."""
    formula = convert(" ".join(latex.split()), display="block")
    return f'<div class="formula" tabindex="0">{formula}</div>'

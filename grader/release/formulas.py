"""Typeset formulas of the handouts: LaTeX between ```math and ``` becomes MathML.

Browsers draw MathML by themselves: a page needs no script and no other server. The file itself
shows the LaTeX, and GitHub and GitLab set the same blocks.
"""

import re

from latex2mathml.converter import convert

BLOCK = re.compile(r"^```math\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def typeset(text: str) -> str:
    """Return the text of a handout with its formulas as MathML, each in a block of its own."""

    def make_html(found: re.Match[str]) -> str:
        formula = convert(" ".join(found[1].split()), display="block")
        return f'<div class="formula" tabindex="0">{formula}</div>'

    return BLOCK.sub(make_html, text)

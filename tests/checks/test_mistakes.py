"""Test the sentences of mistakes.toml, and the models that recognise a mistake."""

from grader.checks.mistakes import MEANINGS, meaning_of
from grader.judge.explain.misconceptions import known_mistakes, load_known
from grader.judge.rubric import load_rubric


def test_every_sentence_names_a_mistake_that_some_model_recognises():
    for todo in load_rubric().todos:
        load_known(todo.id)
    known = {(each.todo, each.id) for each in known_mistakes}
    assert not [
        (todo, name) for todo in MEANINGS for name in MEANINGS[todo] if (todo, name) not in known
    ]


def test_two_mistakes_at_once_have_both_sentences():
    first, second = MEANINGS["4"]["smaller-mu"], MEANINGS["4"]["loses-the-sign"]
    assert meaning_of("4", "smaller-mu+loses-the-sign") == f"{first} Also: {second}"

"""Narrow down wrong answers by their numbers: the questions, the part and the amount.

This states facts and no guesses. They are found first, as a `Narrowing`, and then worded.
"""

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any

from grader.judge.explain.misconceptions import (
    Undecided,
    are_close,
    kinds,
    predict,
)
from grader.judge.lab import Observation
from grader.judge.recorded import key

WHOLE = "the answer"  # the name of the whole answer as a part
CASE = "_case"  # the trait that describes a question
FEWEST = 2  # minimum of answers for a proof
MOST = 3  # maximum of clauses of one kind in a sentence
LONGEST = 150  # maximum of characters of these clauses
IS_WRONG = "is wrong"

Numbers = list[tuple[float, float]]  # of the answer, and of the right one


@dataclass(frozen=True)
class Question:
    """A question with its traits in words, and its answer beside the right one."""

    about: str
    inputs: tuple[Any, ...]
    traits: dict[str, str]
    answer: Any
    right: Any

    @cached_property
    def misfit(self) -> str:
        """Say how the answer differs in kind from the right one; empty if it does not."""
        if isinstance(self.answer, str):
            return f"the answer is {self.answer}"
        if self.answer is None and self.right is not None:
            return "None is returned"
        if self.right is None and self.answer is not None:
            return "there is an answer where None is right"
        ours, theirs = len(flatten(self.answer)), len(flatten(self.right))
        return "" if ours == theirs else f"there are {ours} {self.about} instead of {theirs}"

    @cached_property
    def parts(self) -> dict[str, Any]:
        """Return the parts of the answer by their names."""
        return split(self.about, self.answer)

    @cached_property
    def right_parts(self) -> dict[str, Any]:
        return split(self.about, self.right)

    @cached_property
    def wrong(self) -> frozenset[str]:
        """Return the names of the wrong parts."""
        if are_close(self.answer, self.right):
            return frozenset()
        names = [] if self.misfit else kinds[self.about].parts
        off = [name for name in names if not are_close(self.parts[name], self.right_parts[name])]
        return frozenset(off) or frozenset({WHOLE})


def read_questions(observations: Sequence[Observation]) -> Iterator[Question]:
    """Yield the questions whose right answer is known, each once."""
    found = set()
    for each in observations:
        name = each.about, key(each.inputs)
        if name in found or each.about not in kinds:
            continue
        found.add(name)
        try:
            right = predict(kinds[each.about].right, each.inputs)
            traits = predict(kinds[each.about].traits, each.inputs)
        except Undecided:
            continue
        yield Question(each.about, each.inputs, traits, each.answer, right)


def split(about: str, answer: Any) -> dict[str, Any]:
    """Split an answer into parts; a part without numbers is the whole answer."""
    numbers, found = flatten(answer), {WHOLE: answer}
    for name, places in kinds[about].parts.items():
        has = places and len(numbers) > max(places)
        found[name] = [numbers[place] for place in places] if has else answer
    return found


def flatten(answer: Any) -> list[float]:
    """Return the numbers of an answer of any shape."""
    if isinstance(answer, tuple | list):
        return [number for each in answer for number in flatten(each)]
    return [answer] if isinstance(answer, int | float) else []


# ---------------------------------------------------------------- the facts


@dataclass(frozen=True)
class WrongPart:
    """A wrong part of the answers: how it differs, and in which questions, both in words."""

    name: str
    how: str
    where: str


@dataclass(frozen=True)
class Narrowing:
    """The wrong parts of the answers."""

    wrong: tuple[WrongPart, ...] = ()
    fine: tuple[str, ...] = ()  # parts that are right in all answers
    example: Question | None = None

    @property
    def is_local(self) -> bool:
        """Return whether some trait separates questions with wrong answers from others."""
        return any(f" {each.where}".count(" where ") for each in self.wrong)

    @property
    def words(self) -> str:
        if not self.wrong:
            return ""
        verb = "is" if len(self.fine) == 1 else "are"
        fine = " " + capitalise(f"{' and '.join(self.fine)} {verb} right.") if self.fine else ""
        return word_parts(self.wrong) + fine + (show(self.example) if self.example else "")


def word_parts(wrong: Sequence[WrongPart]) -> str:
    """Return `the normal is turned round where ..., and the depth is too large where ...`."""
    if len({each.where for each in wrong}) == 1:
        if len(wrong) > 1 and {each.how for each in wrong} == {IS_WRONG}:
            words = f"{' and '.join(each.name for each in wrong)} are wrong"
        else:
            words = " and ".join(f"{each.name} {each.how}".strip() for each in wrong)
        return capitalise(f"{words} {wrong[0].where}".strip()) + "."
    clauses = (f"{each.name} {each.how} {each.where}".strip() for each in wrong[:2])
    return " ".join(f"{capitalise(clause)}." for clause in clauses)


def show(question: Question) -> str:
    """Return the answer to one question beside the right one; empty if it has no description."""
    case = question.traits.get(CASE)
    ours, theirs = (word(flatten(each)) for each in (question.answer, question.right))
    return f" In {case}: {ours} instead of {theirs}." if case else ""


def capitalise(words: str) -> str:
    """Begin a sentence with a capital; a name of one letter, such as v, stays small."""
    return words if words[1:2] == " " else words[:1].upper() + words[1:]


def word(numbers: list[float]) -> str:
    shown = ", ".join(f"{number + 0.0:.4g}" for number in numbers)
    return shown if len(numbers) == 1 else f"({shown})"


# ---------------------------------------------------------------- where


def narrow(questions: Sequence[Question], first: Question, parts: frozenset[str]) -> Narrowing:
    """Find where these `parts`, wrong in `first`, are wrong too, and how they differ."""
    same = [each for each in questions if each.about == first.about]
    if first.misfit:
        return narrow_misfit(same, first)
    answered = [each for each in same if not each.misfit]
    names = list(kinds[first.about].parts)
    wrong = [found for name in names if name in parts and (found := narrow_part(answered, name))]
    fine = [name for name in names if not any(name in each.wrong for each in answered)]
    return Narrowing(tuple(wrong), tuple(fine), first)


def narrow_misfit(same: list[Question], first: Question) -> Narrowing:
    wrong = [each for each in same if each.misfit == first.misfit]
    others = [each for each in same if each.misfit != first.misfit]
    where = find_condition(wrong, others, are_right=not any(each.wrong for each in others))
    raised = isinstance(first.answer, str) and not others
    return Narrowing((WrongPart(first.misfit, "", where),)) if where and not raised else Narrowing()


def narrow_part(answered: list[Question], name: str) -> WrongPart | None:
    wrong = [each for each in answered if name in each.wrong]
    others = [each for each in answered if name not in each.wrong]
    where, how = find_condition(wrong, others), find_relation(name, wrong)
    if not where and not how:
        return None
    return WrongPart(name, how or IS_WRONG, where or count(wrong, len(answered)))


def count(wrong: list[Question], asked: int) -> str:
    """Return the number of wrong cases, in words."""
    if len(wrong) > 0.9 * asked:
        return "in nearly every case"
    return f"in {len(wrong)} of {asked} cases"


def find_condition(wrong: list[Question], others: list[Question], are_right: bool = True) -> str:
    """Find a trait that separates the questions with a wrong answer from the others."""
    if not others:
        return "in every case" if len(wrong) > 1 else ""
    kinds = list(dict.fromkeys(k for each in wrong for k in each.traits if k != CASE))
    found = find_traits(wrong, others, kinds, are_right) or find_majority(wrong, others, kinds)
    return found or find_traits(wrong, others, kinds, are_right, is_short=False)


def find_traits(
    wrong: list[Question],
    others: list[Question],
    kinds: list[str],
    are_right: bool,
    is_short: bool = True,
) -> str:
    """Find one or two traits that all the wrong answers have and no others, or the reverse."""
    for number in (1, 2):
        for some in combinations(kinds, number):
            bad, good = count_traits(wrong, *some), count_traits(others, *some)
            many = 2 * len(bad.keys() | good.keys()) > len(wrong) + len(others)
            if many or None in bad or bad.keys() & good.keys():
                continue
            if is_readable(bad, is_short):
                right_too = are_right and number == 1 and is_readable(good)
                return f"where {join(bad)}" + f", and right where {join(good)}" * right_too
            if is_readable(good, is_short):
                return f"but where {join(good)}"
    return ""


def find_majority(wrong: list[Question], others: list[Question], kinds: list[str]) -> str:
    """Find a trait of most of the wrong answers and few others; empty if there is none."""
    best, least = "", len(others) // 2 + 1
    for kind in kinds:
        bad, good = count_traits(wrong, kind), count_traits(others, kind)
        mixed = sum(good[each] for each in bad)
        if is_readable(bad) and mixed < least:
            best, least = f"{count(wrong, len(wrong) + mixed)} where {join(bad)}", mixed
    return best


def is_readable(clauses: Counter[Any], is_short: bool = True) -> bool:
    """Return whether clauses make a readable sentence: short, with few `and` and `or`."""
    if None in clauses or len(clauses) > MOST:
        return False
    words = join(clauses)
    is_plain = " or " not in words or words.count(" and ") <= 1
    return len(words) <= LONGEST and (is_plain or not is_short)


def count_traits(questions: list[Question], *kinds: str) -> Counter[Any]:
    """Count questions by their traits of `kinds`; those that lack one count as None."""
    found: Counter[Any] = Counter()
    for each in questions:
        clauses = [each.traits.get(kind) for kind in kinds]
        found[None if None in clauses else " and ".join(filter(None, clauses))] += 1
    return found


def join(clauses: Iterable[Any]) -> str:
    """Join clauses by `or`; a common beginning comes once."""
    words = [str(each) for each in clauses]
    first, both, _ = words[0].partition(" and ") if len(words) > 1 else ("", "", "")
    if both and all(each.startswith(first + both) for each in words):
        return f"{first}, and {' or '.join(each.removeprefix(first + both) for each in words)}"
    return " or ".join(words)


# ---------------------------------------------------------------- by how much


def find_relation(name: str, wrong: list[Question]) -> str:
    """Find how a part differs from the right one in all questions; empty if that varies."""
    vectors = [(flatten(each.parts[name]), flatten(each.right_parts[name])) for each in wrong]
    pairs = [pair for ours, theirs in vectors for pair in zip(ours, theirs, strict=False)]
    if len(vectors) >= FEWEST:
        for holds, words in RELATIONS:
            if holds(pairs):
                return words
        if are_swapped(vectors):
            return "has its two numbers swapped"
    factor = find_factor(pairs)
    if factor is not None:
        return f"is {factor:.4g} times what it must be"
    ours, theirs = ({tuple(each[side]) for each in vectors} for side in (0, 1))
    if len(theirs) > 1 == len(ours):
        return f"is always {word(vectors[0][0])}"
    off = find_offset(vectors)
    if off:
        return f"is {abs(off):.4g} too {'large' if off > 0 else 'small'}"
    return compare(pairs)


def is_multiple(factor: float) -> Callable[[Numbers], bool]:
    return lambda pairs: all(are_close(ours, factor * theirs) for ours, theirs in pairs)


RELATIONS: tuple[tuple[Callable[[Numbers], bool], str], ...] = (
    (is_multiple(0.0), "is 0"),
    (is_multiple(-1.0), "is turned round: it has the opposite sign"),
    (is_multiple(2.0), "is twice what it must be"),
    (is_multiple(0.5), "is half of what it must be"),
)


def are_swapped(vectors: list[tuple[list[float], list[float]]]) -> bool:
    return all(len(ours) == 2 and are_close(ours[::-1], theirs) for ours, theirs in vectors)


def find_factor(pairs: Numbers) -> float | None:
    """Find the factor between all answers and the right ones; None if it varies."""
    factors = [ours / theirs for ours, theirs in pairs if abs(theirs) > 1e-9]
    if len(factors) < FEWEST or any(
        abs(ours) > 1e-6 for ours, theirs in pairs if abs(theirs) <= 1e-9
    ):
        return None
    same = all(math.isclose(each, factors[0], rel_tol=1e-6) for each in factors)
    return factors[0] if same and len({round(theirs, 6) for _, theirs in pairs}) > 1 else None


def find_offset(vectors: list[tuple[list[float], list[float]]]) -> float:
    """Find the constant error of a single number; 0 if it varies."""
    offs = [ours[0] - theirs[0] for ours, theirs in vectors if len(ours) == len(theirs) == 1]
    if len(offs) < max(FEWEST, len(vectors)):
        return 0.0
    return offs[0] if all(math.isclose(each, offs[0], rel_tol=1e-6) for each in offs) else 0.0


def compare(pairs: Numbers) -> str:
    """Return `is too large` or `is too small` if that is true of all wrong numbers."""
    off = [(ours, theirs) for ours, theirs in pairs if not are_close(ours, theirs)]
    for words, is_more in (("is too large", True), ("is too small", False)):
        if all(a * b >= 0 and abs(a) != abs(b) and (abs(a) > abs(b)) == is_more for a, b in off):
            return words
    return ""

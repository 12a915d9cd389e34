"""What is wrong where no known mistake explains every answer: half done, or wrong in two ways.

A known mistake is told by the questions that it shows in, such as those from outside the box, and
by the parts of the answer that it changes, such as the normal. It must give each of these as the
submission did. Two mistakes that give the same are none.

Where none fits, what is wrong is narrowed down by numbers: in which questions, in which part of the
answer, and by how much. That is what was observed and no guess.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Any

from grader.judge.lab import Observation
from grader.judge.misconceptions import (
    Mistake,
    Undecided,
    alike,
    known,
    load_known,
    parts,
    right,
    said,
    separate,
    simplest,
    traits,
)
from grader.judge.recorded import key

WHOLE = "the answer"  # the name of a part where an answer has none, or is another kind of thing
CASE = "_case"  # the name of what a question is, in words
FEWEST = 2  # answers that a mistake must explain to be told by a part of the questions
MOST = 3  # clauses of one kind in a sentence
LONGEST = 150  # characters of these


@dataclass(frozen=True)
class Seen:
    """A question, what it is like, and its answer beside the right one."""

    about: str
    inputs: tuple[Any, ...]
    like: dict[str, str]
    answer: Any
    right: Any

    @cached_property
    def kind(self) -> str:
        """What is wrong where the answer is no such thing as the right one; else empty."""
        if isinstance(self.answer, str):
            return f"the answer is {self.answer}"
        if self.answer is None and self.right is not None:
            return "there is no answer (None; is a return missing?)"
        if self.right is None and self.answer is not None:
            return "there is an answer where None is right"
        ours, theirs = len(self.numbers), len(flat(self.right))
        return "" if ours == theirs else f"there are {ours} {self.about} instead of {theirs}"

    @cached_property
    def numbers(self) -> list[float]:
        return flat(self.answer)

    @cached_property
    def pieces(self) -> dict[str, Any]:
        """The parts of the answer by their names."""
        return pieces_of(self.about, self.answer)

    @cached_property
    def right_pieces(self) -> dict[str, Any]:
        """The same of the right one."""
        return pieces_of(self.about, self.right)

    @cached_property
    def wrong(self) -> frozenset[str]:
        """The parts of the answer that are wrong."""
        if alike(self.answer, self.right):
            return frozenset()
        names = [] if self.kind else parts.get(self.about, {})
        off = [name for name in names if not alike(self.pieces[name], self.right_pieces[name])]
        return frozenset(off) or frozenset({WHOLE})


def pieces_of(about: str, answer: Any) -> dict[str, Any]:
    """The parts of an answer; each is all of it where it is another kind of thing."""
    numbers, found = flat(answer), {WHOLE: answer}
    for name, places in parts.get(about, {}).items():
        has = places and len(numbers) > max(places)
        found[name] = [numbers[place] for place in places] if has else answer
    return found


@dataclass(frozen=True)
class Finding:
    """A known mistake in some of the questions and some parts of their answers."""

    mistake: Mistake
    where: str  # a clause, or empty where it needs none
    part: str  # of the answer, or empty where the mistake is all there
    changed: frozenset[str]  # the parts of the answer
    explains: frozenset[int]  # the numbers of the questions

    @property
    def meaning(self) -> str:
        places = [f"where {self.where}"] * bool(self.where) + [f"in {self.part}"] * bool(self.part)
        return sentence(", ".join(places) + ": " * bool(places) + self.mistake.meaning)


def together(findings: Iterable[Finding]) -> list[Finding]:
    """The findings, of which each mistake in the same part is told once, wherever it shows."""
    found: dict[tuple[Mistake, str], Finding] = {}
    for each in findings:
        before = found.get((each.mistake, each.part), each)
        clauses = dict.fromkeys((before.where, each.where))
        where = "" if "" in clauses else either(clauses)
        found[each.mistake, each.part] = replace(before, where=where)
    return list(found.values())


class Diagnosis:
    """What can be told of a TODO by its answers."""

    def __init__(self, todo: str, observations: Sequence[Observation]) -> None:
        load_known(todo)
        self.mistakes = [each for each in known if each.todo == todo]
        self.seen = list(seen_of(observations))
        self.predictions: dict[tuple[Mistake, int], Seen | None] = {}
        self.findings = [
            finding
            for about in dict.fromkeys(s.about for s in self.seen)
            for finding in self.find(about)
        ]

    def of(self, observations: Sequence[Observation]) -> str:
        """What the answers of one check mean; empty where nothing can be told.

        The first wrong one is spoken of, by the known mistakes that show in it. What these leave
        unexplained of it is narrowed down.
        """
        asked = {(each.about, key(each.inputs)) for each in observations}
        numbers = [
            number
            for number, each in enumerate(self.seen)
            if each.wrong and (each.about, key(each.inputs)) in asked
        ]
        if not numbers:
            return ""
        first = self.seen[numbers[0]]
        here = [each for each in self.findings if each.explains.intersection(numbers)]
        explained = [each.changed for each in here if numbers[0] in each.explains]
        told = [each.meaning for each in together(here)] if explained else []
        left = first.wrong.difference(*explained)
        narrowed = narrow(self.seen, first, left) if left else ""
        if not told and " where " not in narrowed:
            about = [each for each in self.findings if each.mistake.about == first.about]
            told = [each.meaning for each in together(about)]
        if (narrowed and not told) or " where " in narrowed:
            told.append(narrowed)
        return " And: ".join(dict.fromkeys(told[:2]))

    # ------------------------------------------------------------ known mistakes

    def find(self, about: str) -> list[Finding]:
        """The mistakes told by the questions of one kind, the one that shows in most first."""
        numbers = [n for n, each in enumerate(self.seen) if each.about == about]
        wrong = [n for n in numbers if self.seen[n].wrong]
        if not wrong:
            return []
        names = dict.fromkeys(name for n in numbers for name in self.seen[n].like)
        kinds = [name for name in names if not name.startswith("_")]
        best: list[Finding] = []
        for way in [(), *combinations(kinds, 1), *combinations(kinds, 2)]:
            if best and len(way) == 2:
                break  # the smaller the groups are, the more fits by chance
            group = self.groups(numbers, way)
            found = [
                each
                for where, some in group
                for each in self.named(where, some)
                if len(each.explains) > len(way) and self.telling(each)
            ]
            if self.explained(found) > self.explained(best):
                best = found
        return best

    def telling(self, finding: Finding) -> bool:
        """Whether more speaks for it than answers that are missing in some of the questions.

        Nothing at all is what many mistakes leave of an answer, and this one would show elsewhere.
        """
        return not finding.where or any(self.seen[n].answer is not None for n in finding.explains)

    def explained(self, findings: list[Finding]) -> int:
        """How many wrong parts of answers these mistakes explain."""
        return len(
            {
                (n, part)
                for f in findings
                for n in f.explains
                for part in f.changed & self.seen[n].wrong
            }
        )

    def groups(self, numbers: list[int], kinds: tuple[str, ...]) -> list[tuple[str, list[int]]]:
        """The questions by what they are like in these ways."""
        found: dict[str, list[int]] = {}
        for number in numbers:
            like = self.seen[number].like
            if all(kind in like for kind in kinds):
                found.setdefault(" and ".join(like[kind] for kind in kinds), []).append(number)
        return list(found.items())

    def named(self, where: str, numbers: list[int]) -> list[Finding]:
        """Return the mistakes that together give every number of all these answers, or none."""
        found: list[Finding] = []
        covered: frozenset[str] = frozenset()
        wrong = [n for n in numbers if self.seen[n].wrong]
        while len(wrong) >= FEWEST:
            left = frozenset(name for n in wrong for name in self.seen[n].wrong) - covered
            if not left:
                break
            fit = [
                (each, changed)
                for each in self.mistakes
                if each.about == self.seen[wrong[0]].about
                and (changed := self.fits(each, numbers, covered)) & left
            ]
            chosen = self.chosen(fit, numbers)
            if chosen is None:
                break
            mistake, changed = chosen
            covered |= changed
            shows = frozenset(n for n in wrong if self.seen[n].wrong & changed)
            clause = where if self.elsewhere(mistake, numbers) else ""
            more = self.changes(mistake, numbers) - changed
            part = either(name for name in parts[mistake.about] if name in changed) if more else ""
            found.append(Finding(mistake, clause, part, changed, shows))
        is_all = all(self.seen[n].wrong <= covered for n in wrong)
        return found if is_all else []

    def fits(self, mistake: Mistake, numbers: list[int], covered: frozenset[str]) -> frozenset[str]:
        """The parts that a mistake changes; none where one of them is not as in the answers.

        What is `covered` another mistake has changed already.
        """
        both = [(self.seen[n], self.predicted(mistake, n)) for n in numbers]
        decided = [(each, predicted) for each, predicted in both if predicted is not None]
        changed = frozenset[str]().union(*(p.wrong for _, p in decided)) - covered
        shows = sum(bool(predicted.wrong & changed) for _, predicted in decided)
        told = sum(bool(each.wrong) for each, _ in decided)
        if shows < FEWEST or 2 * told < sum(bool(each.wrong) for each, _ in both):
            return frozenset()
        as_seen = frozenset(
            name
            for name in changed
            if all(alike(predicted.pieces[name], each.pieces[name]) for each, predicted in decided)
        )
        return as_seen if as_seen == changed or mistake.about in separate else frozenset()

    def changes(self, mistake: Mistake, numbers: list[int]) -> frozenset[str]:
        """The parts that a mistake changes in any of these questions."""
        predicted = [self.predicted(mistake, number) for number in numbers]
        return frozenset[str]().union(*(each.wrong for each in predicted if each is not None))

    def predicted(self, mistake: Mistake, number: int) -> Seen | None:
        """A question with the answer that a mistake gives to it, if there is one."""
        if (mistake, number) not in self.predictions:
            each, found = self.seen[number], None
            if each.about == mistake.about:
                with suppress(Undecided):
                    answer = said(mistake.model, each.inputs)
                    found = Seen(each.about, each.inputs, each.like, answer, each.right)
            self.predictions[mistake, number] = found
        return self.predictions[mistake, number]

    def chosen(
        self, fit: list[tuple[Mistake, frozenset[str]]], numbers: list[int]
    ) -> tuple[Mistake, frozenset[str]] | None:
        """The mistake that changes most; of several that change the same, the one that fits all.

        Where still several do, none of what they change is told of by another one.
        """
        tied: frozenset[str] = frozenset()
        order = sorted({changed for _, changed in fit}, key=lambda c: (-len(c), sorted(c)))
        for changed in order:
            best = [each for each, some in fit if some == changed]
            if len(simplest({each.id for each in best})) > 1:
                best = [each for each in best if self.changes(each, numbers) <= changed]
            if len(simplest({each.id for each in best})) > 1:
                best = [each for each in best if not self.denied(each, changed)]
            left = simplest({each.id for each in best})
            if len(left) == 1 and not changed <= tied:
                return next(each for each in best if each.id == left[0]), changed
            tied |= changed
        return None

    def denied(self, mistake: Mistake, changed: frozenset[str]) -> bool:
        """Whether a mistake would show in other questions as well, and does not."""
        for number, each in enumerate(self.seen):
            predicted = self.predicted(mistake, number)
            if predicted is not None and any(
                not alike(predicted.pieces[n], each.pieces[n]) for n in predicted.wrong & changed
            ):
                return True
        return False

    def elsewhere(self, mistake: Mistake, numbers: list[int]) -> bool:
        """Whether a mistake would show outside of these questions too."""
        outside = set(range(len(self.seen))).difference(numbers)
        return any(p is not None and p.wrong for p in (self.predicted(mistake, n) for n in outside))


def seen_of(observations: Sequence[Observation]) -> Iterable[Seen]:
    """The questions with a right answer, each once."""
    asked = set()
    for each in observations:
        name = each.about, key(each.inputs)
        if name in asked or each.about not in right:
            continue
        asked.add(name)
        try:
            meant = said(right[each.about], each.inputs)
            like = said(traits[each.about], each.inputs) if each.about in traits else {}
        except Undecided:
            continue
        yield Seen(each.about, each.inputs, like, each.answer, meant)


def flat(answer: Any) -> list[float]:
    """The numbers of an answer, whatever its shape."""
    if isinstance(answer, tuple | list):
        return [number for each in answer for number in flat(each)]
    return [answer] if isinstance(answer, int | float) else []


# ---------------------------------------------------------------- narrowed down by numbers


def narrow(seen: Sequence[Seen], first: Seen, left: frozenset[str]) -> str:
    """In which questions these parts are wrong as in the first one, and how; empty if unknown."""
    alike_asked = [each for each in seen if each.about == first.about]
    if first.kind:
        wrong = [each for each in alike_asked if each.kind == first.kind]
        others = [each for each in alike_asked if each.kind != first.kind]
        where = condition(wrong, others)
        raised = isinstance(first.answer, str) and not others
        return f"{sentence(first.kind)} {where}." if where and not raised else ""
    told = []
    names = list(parts.get(first.about, {}))
    for name in [name for name in names if name in left]:
        wrong = [each for each in alike_asked if not each.kind and name in each.wrong]
        others = [each for each in alike_asked if each not in wrong and not each.kind]
        where, how = condition(wrong, others), relation(name, wrong)
        if where or how:
            many = f"in {len(wrong)} of {len(wrong) + len(others)} questions"
            told.append((name, how or "is wrong", where or many))
    answered = [each for each in alike_asked if not each.kind]
    fine = [name for name in names if not any(name in each.wrong for each in answered)]
    right_too = f" {sentence(' and '.join(fine))} {'is' if len(fine) == 1 else 'are'} right."
    return joined(told) + right_too * bool(told and fine) + example(first) * bool(told)


def example(seen: Seen) -> str:
    """The answer to one question beside the right one, where the question can be said in words."""
    case = seen.like.get(CASE)
    ours, theirs = (in_words(flat(each)) for each in (seen.answer, seen.right))
    return f" In {case}: {ours} instead of {theirs}." if case else ""


def joined(told: list[tuple[str, str, str]]) -> str:
    """`the normal is turned round where ..., and the depth is too large where ...`."""
    if not told:
        return ""
    if len({where for _, _, where in told}) == 1:
        words = " and ".join(f"{name} {how}" for name, how, _ in told)
        return sentence(f"{words} {told[0][2]}".strip()) + "."
    return " ".join(
        sentence(f"{name} {how} {where}".strip()) + "." for name, how, where in told[:2]
    )


def sentence(words: str) -> str:
    return words[:1].upper() + words[1:]


def condition(wrong: list[Seen], others: list[Seen]) -> str:
    """What tells the questions with a wrong answer from the others, from what they are like."""
    if not others:
        return "in every question" if len(wrong) > 1 else ""
    kinds = list(dict.fromkeys(k for each in wrong for k in each.like if k != CASE))
    for ways in (1, 2):
        for some in combinations(kinds, ways):
            bad, good = values(wrong, *some), values(others, *some)
            many = 2 * len(bad.keys() | good.keys()) > len(wrong) + len(others)
            if many or None in bad or bad.keys() & good.keys():
                continue
            if few(bad):
                right_too = f", and right where {either(good)}" if few(good) and ways == 1 else ""
                return f"where {either(bad)}{right_too}"
            if few(good):
                return f"but where {either(good)}"
    return partly(wrong, others, kinds)


def few(clauses: dict[Any, int]) -> bool:
    """Whether they make a clause that can be read."""
    return None not in clauses and len(clauses) <= MOST and len(either(clauses)) <= LONGEST


def partly(wrong: list[Seen], others: list[Seen], kinds: list[str]) -> str:
    """Where most of the wrong answers are and few others; empty where that is nowhere."""
    best, least = "", len(others) // 2 + 1
    for kind in kinds:
        bad, good = values(wrong, kind), values(others, kind)
        mixed = sum(good[each] for each in bad if each in good)
        if few(bad) and mixed < least:
            best, least = (
                f"in {len(wrong)} of {len(wrong) + mixed} questions where {either(bad)}",
                mixed,
            )
    return best


def values(seen: list[Seen], *kinds: str) -> dict[Any, int]:
    """What questions are like in these ways, and how many are."""
    found: dict[Any, int] = {}
    for each in seen:
        clauses = [each.like.get(kind) for kind in kinds]
        name = None if None in clauses else " and ".join(filter(None, clauses))
        found[name] = found.get(name, 0) + 1
    return found


def either(clauses: Iterable[Any]) -> str:
    """One of the clauses; what all begin with is said once."""
    told = [str(each) for each in clauses]
    first, both, _ = told[0].partition(" and ") if len(told) > 1 else ("", "", "")
    if both and all(each.startswith(first + both) for each in told):
        return f"{first}, and {' or '.join(each.removeprefix(first + both) for each in told)}"
    return " or ".join(told)


# ---------------------------------------------------------------- by how much


Numbers = list[tuple[float, float]]  # of the answer, and of the right one


def relation(name: str, wrong: list[Seen]) -> str:
    """How a part of the answers differs from the right one in all of these; empty if it varies."""
    vectors = [(flat(each.pieces[name]), flat(each.right_pieces[name])) for each in wrong]
    pairs = [pair for ours, theirs in vectors for pair in zip(ours, theirs, strict=False)]
    for holds, words in RELATIONS if len(vectors) >= FEWEST else ():
        if holds(pairs):
            return words
    if len(vectors) >= FEWEST and same_swapped(vectors):
        return "has its two numbers swapped"
    factor = one_factor(pairs)
    if factor is not None:
        return f"is {factor:.4g} times what it must be"
    if (
        len({tuple(theirs) for _, theirs in vectors})
        > 1
        == len({tuple(ours) for ours, _ in vectors})
    ):
        return f"is always {in_words(vectors[0][0])}"
    off = one_offset(vectors)
    if off:
        return f"is {abs(off):.4g} too {'large' if off > 0 else 'small'}"
    return compared(pairs)


def times(factor: float) -> Callable[[Numbers], bool]:
    return lambda pairs: all(alike(ours, factor * theirs) for ours, theirs in pairs)


RELATIONS: tuple[tuple[Callable[[Numbers], bool], str], ...] = (
    (times(0.0), "is 0"),
    (times(-1.0), "is turned round: it has the opposite sign"),
    (times(2.0), "is twice what it must be"),
    (times(0.5), "is half of what it must be"),
)


def same_swapped(vectors: list[tuple[list[float], list[float]]]) -> bool:
    return all(len(ours) == 2 and alike(ours[::-1], theirs) for ours, theirs in vectors)


def one_factor(pairs: Numbers) -> float | None:
    """The factor between all answers and the right ones; None where there is no one such."""
    factors = [ours / theirs for ours, theirs in pairs if abs(theirs) > 1e-9]
    if len(factors) < FEWEST or any(
        abs(ours) > 1e-6 for ours, theirs in pairs if abs(theirs) <= 1e-9
    ):
        return None
    same = all(math.isclose(each, factors[0], rel_tol=1e-6) for each in factors)
    return factors[0] if same and len({round(theirs, 6) for _, theirs in pairs}) > 1 else None


def one_offset(vectors: list[tuple[list[float], list[float]]]) -> float:
    """By how much a single number is always off; 0 where it varies."""
    offs = [ours[0] - theirs[0] for ours, theirs in vectors if len(ours) == len(theirs) == 1]
    if len(offs) < max(FEWEST, len(vectors)):
        return 0.0
    return offs[0] if all(math.isclose(each, offs[0], rel_tol=1e-6) for each in offs) else 0.0


def compared(pairs: Numbers) -> str:
    """Whether all the numbers that are off are too large, or too small."""
    off = [(ours, theirs) for ours, theirs in pairs if not alike(ours, theirs)]
    if all(ours * theirs >= 0 and abs(ours) > abs(theirs) for ours, theirs in off):
        return "is too large"
    if all(ours * theirs >= 0 and abs(ours) < abs(theirs) for ours, theirs in off):
        return "is too small"
    return ""


def in_words(numbers: list[float]) -> str:
    told = ", ".join(f"{number + 0.0:.4g}" for number in numbers)
    return told if len(numbers) == 1 else f"({told})"

"""Diagnose answers that no single known mistake explains: half done work, or two mistakes.

A known mistake may show in some questions only, such as those from outside the box, and in some
parts of the answer, such as the normal. The named mistakes must together predict every number
of the answers. If two mistakes fit equally well, none is named.
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import combinations, islice

from grader.judge.explain.misconceptions import (
    Mistake,
    Undecided,
    are_close,
    keep_simplest,
    kinds,
    known_mistakes,
    load_known,
    predict,
)
from grader.judge.explain.narrowing import FEWEST, Narrowing, Question, join, narrow, read_questions
from grader.judge.lab import Observation
from grader.judge.recorded import key


@dataclass(frozen=True)
class Finding:
    """A known mistake in some of the questions and some parts of their answers."""

    mistake: Mistake
    where: str  # a clause about the questions; empty for all of them
    part: str  # parts of the answer; empty if all changes of the mistake appear
    changed: frozenset[str]  # parts of the answer
    explains: frozenset[int]  # indices of questions

    @property
    def meaning(self) -> str:
        places = [f"in {self.part}"] * bool(self.part) + [f"where {self.where}"] * bool(self.where)
        shows = f" It shows {', '.join(places)}." if places else ""
        return self.mistake.meaning + shows


def merge_findings(findings: Iterable[Finding]) -> list[Finding]:
    """Merge findings of one mistake in the same part of the answer."""
    found: dict[tuple[Mistake, str], Finding] = {}
    for each in findings:
        before = found.get((each.mistake, each.part), each)
        clauses = dict.fromkeys((before.where, each.where))
        where = "" if "" in clauses else join(clauses)
        found[each.mistake, each.part] = replace(before, where=where)
    return list(found.values())


def join_words(sentences: Iterable[str]) -> str:
    """Join the first two sentences, if they differ."""
    return " Also: ".join(filter(None, dict.fromkeys(islice(sentences, 2))))


class Diagnosis:
    """The findings about a TODO, by its answers."""

    def __init__(self, todo: str, observations: Sequence[Observation]) -> None:
        load_known(todo)
        self.mistakes = [each for each in known_mistakes if each.todo == todo]
        self.questions = list(read_questions(observations))
        self.predictions: dict[tuple[Mistake, int], Question | None] = {}
        self.findings = [
            finding
            for about in dict.fromkeys(s.about for s in self.questions)
            for finding in self.find_mistakes(about)
        ]

    def describe(self, observations: Sequence[Observation]) -> str:
        """Return the meaning of one check's answers; empty if none is found.

        The first wrong answer decides: the known mistakes that show in it are named, and the parts
        of it that they do not explain are narrowed down.
        """
        asked = {(each.about, key(each.inputs)) for each in observations}
        numbers = [
            number
            for number, each in enumerate(self.questions)
            if each.wrong and (each.about, key(each.inputs)) in asked
        ]
        if not numbers:  # its answers are nearly right: take the findings of other checks
            return join_words(each.meaning for each in merge_findings(self.findings))
        first = self.questions[numbers[0]]
        here = [each for each in self.findings if each.explains.intersection(numbers)]
        explained = [each.changed for each in here if numbers[0] in each.explains]
        words = [each.meaning for each in merge_findings(here)] if explained else []
        unexplained = first.wrong.difference(*explained)
        narrowed = narrow(self.questions, first, unexplained) if unexplained else Narrowing()
        if not words and not narrowed.is_local:
            same = [each for each in self.findings if each.mistake.about == first.about]
            words = [each.meaning for each in merge_findings(same)]
        if narrowed.is_local or not words:
            words.append(narrowed.words)
        return join_words(words)

    # ------------------------------------------------------------ known mistakes

    def find_mistakes(self, about: str) -> list[Finding]:
        """Find the mistakes that explain most wrong answers to one kind of question.

        The questions are grouped by no trait, by one, or by two.
        """
        numbers = [n for n, each in enumerate(self.questions) if each.about == about]
        wrong = [n for n in numbers if self.questions[n].wrong]
        if not wrong:
            return []
        names = dict.fromkeys(name for n in numbers for name in self.questions[n].traits)
        kinds = [name for name in names if not name.startswith("_")]
        best: list[Finding] = []
        for traits in [(), *combinations(kinds, 1), *combinations(kinds, 2)]:
            if best and len(traits) == 2:
                break  # in small groups, mistakes fit by chance
            found = [
                each
                for where, some in self.group(numbers, traits)
                for each in self.explain_group(where, some)
                if len(each.explains) > len(traits) and self.is_telling(each)
            ]
            if self.count_explained(found) > self.count_explained(best):
                best = found
        return best

    def is_telling(self, finding: Finding) -> bool:
        """Return whether a mistake explains more than missing answers, which fit many mistakes."""
        return not finding.where or any(
            self.questions[n].answer is not None for n in finding.explains
        )

    def count_explained(self, findings: list[Finding]) -> int:
        """Return how many wrong parts of answers these mistakes explain."""
        return len(
            {
                (n, part)
                for f in findings
                for n in f.explains
                for part in f.changed & self.questions[n].wrong
            }
        )

    def group(self, numbers: list[int], kinds: tuple[str, ...]) -> list[tuple[str, list[int]]]:
        """Group questions by their traits of these `kinds`."""
        found: dict[str, list[int]] = {}
        for number in numbers:
            traits = self.questions[number].traits
            if all(kind in traits for kind in kinds):
                found.setdefault(" and ".join(traits[kind] for kind in kinds), []).append(number)
        return list(found.items())

    def explain_group(self, where: str, numbers: list[int]) -> list[Finding]:
        """Return mistakes that together predict every number of these answers, or none."""
        found: list[Finding] = []
        covered: frozenset[str] = frozenset()
        wrong = [n for n in numbers if self.questions[n].wrong]
        while len(wrong) >= FEWEST:
            left = frozenset(name for n in wrong for name in self.questions[n].wrong) - covered
            if not left:
                break
            fit = [
                (each, changed)
                for each in self.mistakes
                if each.about == self.questions[wrong[0]].about
                and (changed := self.find_changed(each, numbers, covered)) & left
            ]
            chosen = self.choose(fit, numbers)
            if chosen is None:
                break
            mistake, changed = chosen
            covered |= changed
            shows = frozenset(n for n in wrong if self.questions[n].wrong & changed)
            clause = where if self.shows_elsewhere(mistake, numbers) else ""
            more = self.find_changes(mistake, numbers) - changed
            part = (
                join(name for name in kinds[mistake.about].parts if name in changed) if more else ""
            )
            found.append(Finding(mistake, clause, part, changed, shows))
        return found if self.is_complete(found, wrong, covered) else []

    def is_complete(self, found: list[Finding], wrong: list[int], covered: frozenset[str]) -> bool:
        """Return whether `found` explains all that is wrong in its answers."""
        decided = [n for n in wrong if any(self.predict(each.mistake, n) for each in found)]
        return all(self.questions[n].wrong <= covered for n in decided)

    def find_changed(
        self, mistake: Mistake, numbers: list[int], covered: frozenset[str]
    ) -> frozenset[str]:
        """Return the parts that a mistake changes; none if answers contradict one.

        Omit `covered` parts: other mistakes explain them.
        """
        both = [(self.questions[n], self.predict(mistake, n)) for n in numbers]
        decided = [(each, predicted) for each, predicted in both if predicted is not None]
        changed = frozenset[str]().union(*(p.wrong for _, p in decided)) - covered
        shows = sum(bool(predicted.wrong & changed) for _, predicted in decided)
        wrong = sum(bool(each.wrong) for each, _ in decided)
        if shows < FEWEST or 2 * wrong < sum(bool(each.wrong) for each, _ in both):
            return frozenset()
        matching = frozenset(
            name
            for name in changed
            if all(
                are_close(predicted.parts[name], each.parts[name]) for each, predicted in decided
            )
        )
        may_be_in_a_part = mistake.apart and kinds[mistake.about].apart
        return matching if matching == changed or may_be_in_a_part else frozenset()

    def find_changes(self, mistake: Mistake, numbers: list[int]) -> frozenset[str]:
        """Return the parts that a mistake changes in any of these questions."""
        predicted = [self.predict(mistake, number) for number in numbers]
        return frozenset[str]().union(*(each.wrong for each in predicted if each is not None))

    def predict(self, mistake: Mistake, number: int) -> Question | None:
        """Return a question as a mistake answers it; None if it has no answer."""
        if (mistake, number) not in self.predictions:
            each, found = self.questions[number], None
            if each.about == mistake.about:
                with suppress(Undecided):
                    answer = predict(mistake.model, each.inputs)
                    found = Question(each.about, each.inputs, each.traits, answer, each.right)
            self.predictions[mistake, number] = found
        return self.predictions[mistake, number]

    def choose(
        self, fit: list[tuple[Mistake, frozenset[str]]], numbers: list[int]
    ) -> tuple[Mistake, frozenset[str]] | None:
        """Choose the mistake that changes most parts; among equals, one that fits all answers.

        If several still fit, none is named, nor any other for the same parts.
        """
        tied: frozenset[str] = frozenset()
        order = sorted({changed for _, changed in fit}, key=lambda c: (-len(c), sorted(c)))
        for changed in order:
            best = [each for each, some in fit if some == changed]
            if len(keep_simplest({each.id for each in best})) > 1:
                best = [each for each in best if self.find_changes(each, numbers) <= changed]
            if len(keep_simplest({each.id for each in best})) > 1:
                best = [each for each in best if not self.is_denied(each, changed)]
            left = keep_simplest({each.id for each in best})
            if len(left) == 1 and not changed <= tied:
                return next(each for each in best if each.id == left[0]), changed
            tied |= changed
        return None

    def is_denied(self, mistake: Mistake, changed: frozenset[str]) -> bool:
        """Return whether other answers contradict a mistake."""
        for number, each in enumerate(self.questions):
            predicted = self.predict(mistake, number)
            if predicted is not None and any(
                not are_close(predicted.parts[n], each.parts[n]) for n in predicted.wrong & changed
            ):
                return True
        return False

    def shows_elsewhere(self, mistake: Mistake, numbers: list[int]) -> bool:
        """Return whether a mistake also changes answers to other questions."""
        outside = set(range(len(self.questions))).difference(numbers)
        return any(p is not None and p.wrong for p in (self.predict(mistake, n) for n in outside))
